"use strict";

// Derivations under `hand` compared with the assembled equations, and an answer graded by the text of the editor as its key.

const checker = { client: null, text: "", said: null };

function sayChecked(...said) {
  checker.said = said;
  element("live-checked").textContent = phrase(...said);
}

// Call the library with the texts; show the errors of its answer, or showAnswer(the value under `key`) where there are none.
function requestCheck(call, texts, key, showAnswer) {
  checker.text = editor.value;
  element("live-verdict").replaceChildren();
  markVerdict(checker.text);
  sayChecked("live-checking");
  checker.client = checker.client || makeClient(() => {});
  checker.client.failed = (message) => sayChecked("live-check-failed", message);
  checker.client.request(call, texts, (answer) => {
    const found = JSON.parse(answer || "{\"errors\":[]}"), wrong = found.errors.filter(({ severity }) => severity === "error");
    if (found[key] && !wrong.length) { showAnswer(found[key]); return; }
    sayChecked("live-unchecked");
    element("live-verdict").replaceChildren(...wrong.map(noteItem));
  }, [1]);
}

// Mark a verdict on an earlier text.
function markVerdict(text) {
  element("live-earlier").hidden = !element("live-verdict").childElementCount || text === checker.text;
}

function verdictItem(right, title, lines) {
  const item = make("li", right ? "right" : "wrong", make("b", "", right ? "✓ " : "✗ "), title);
  item.append(...lines.map((line) => make("small", "", line)));
  return item;
}

// ---- derivations

// An equation is a line of the text; its verdict follows on indented lines.
function showHand({ differing, text }) {
  const blocks = text.split(/\n(?! |$)/).map((block) => block.trimEnd().split("\n")).filter((lines) => lines.length > 1);
  element("live-verdict").replaceChildren(...blocks.map(([title, ...lines]) =>
    verdictItem(lines.some((line) => /^ {2}(agrees|holds) at /.test(line)), title, lines)));
  if (blocks.length) sayChecked("live-agree", blocks.length - differing, blocks.length);
  else sayChecked("live-no-hand");
}

// ---- an answer

function findingItem({ kind, name, points, max_points: most, message, output }) {
  const title = `${name ? `${name}: ` : ""}${message} (${show(points)} / ${show(most)})`;
  return verdictItem(kind === "right" || (most > 0 && points >= most), title, output ? output.split("\n") : []);
}

function showGrade(grade, student) {
  sayChecked("live-points", student, show(grade.points), show(grade.max_points));
  element("live-verdict").replaceChildren(...grade.tests.map(findingItem));
}

async function gradeAnswer() {
  const box = element("live-answer"), [file] = box.files;
  if (!file) return;
  const student = file.name.replace(/\.\w+$/, ""), text = await file.text();
  requestCheck("grade", [editor.value, "", text, student], "grade", (grade) => showGrade(grade, student));
  box.value = ""; // the same file may be graded again
}

function connectCheck() {
  element("live-hand").addEventListener("click", () => requestCheck("check_hand", [editor.value, parts.name], "hand", showHand));
  element("live-grade").addEventListener("click", () => element("live-answer").click());
  element("live-answer").addEventListener("change", gradeAnswer);
}
