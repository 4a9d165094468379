"use strict";

// The verdict of `fbd-run --grade` on the drawing, in pages with the library and the key: not in those for an exam.

const verdict = { client: null };

// Mark each finding at its entry or line; of two the worse one.
function markFindings(tests, places) {
  drawing.marks.clear();
  for (const { kind, points, max_points: most, line, message } of tests) {
    const place = places.get(line), right = kind === "right" || (most > 0 && points >= most);
    if (!place) continue;
    const key = place.entry ? place.entry.id : `${place.body}:${place.line}`, before = drawing.marks.get(key);
    if (!before || before.right) drawing.marks.set(key, { right, message });
  }
}

function findingItem({ name, points, max_points: most, message }) {
  const worth = most > 0 || points !== 0 ? `${show(points)} of ${show(most)}` : "";
  const text = make("span", { className: most > 0 ? (points >= most ? "right" : "wrong") : "" }, `${name ? `${name}: ` : ""}${message}`);
  return make("li", {}, make("span", { className: "worth" }, worth), text);
}

function showVerdict(answer, places) {
  const { errors, grade } = JSON.parse(answer || "{\"errors\":[],\"grade\":null}");
  element("verdict").hidden = !grade;
  element("check").disabled = false;
  if (!grade) {
    element("says").textContent = errors[0]?.message || "this browser has no memory left for it";
    return;
  }
  element("says").textContent = grade.message || "";
  element("points").textContent = `${show(grade.points, 4)} of ${show(grade.max_points, 4)} points${grade.passed ? ", passed" : ""}`;
  element("findings").replaceChildren(...grade.tests.map(findingItem));
  markFindings(grade.tests, places);
  showAll();
}

async function beginGrading() {
  await compileEngine();
  verdict.client = makeClient(() => {});
  verdict.client.failed = (message) => { element("says").textContent = `the check has failed: ${message}`; element("check").disabled = false; };
}

async function check() {
  const { text, places } = answerOf();
  element("check").disabled = true;
  element("says").textContent = "checking…";
  try {
    if (!verdict.client) await beginGrading();
    verdict.client.request("grade", [parts.key, parts.settings, text, sheet.student], (answer) => showVerdict(answer, places), [0]);
  } catch (error) {
    element("says").textContent = `this browser cannot run the library: ${error.message}`;
    element("check").disabled = false;
  }
}

function connectVerdict() {
  element("check").hidden = sheet.exam;
  element("check").addEventListener("click", check);
}
