"use strict";

// The texts of the page, all of them in texts.json, and the scene in words for who cannot see it.

const phrases = JSON.parse(element("texts").textContent);
let language = "en";

function make(tag, css, ...children) {
  const node = document.createElement(tag);
  node.className = css;
  node.append(...children);
  return node;
}

function listen(id, kind, action) {
  element(id).addEventListener(kind, action);
}

function makeButton(...children) {
  const button = make("button", "", ...children);
  button.type = "button";
  return button;
}

// The text of a key in the chosen language, with the values in the places {0}, {1}.
function phrase(key, ...values) {
  return phrases[language][key].replace(/\{(\d)\}/g, (whole, i) => values[i]);
}

// The first language of the browser that the page has, else English.
function chooseLanguage() {
  language = navigator.languages.map((name) => name.slice(0, 2)).find((name) => name in phrases) || "en";
  for (const name of Object.keys(phrases)) element("language").add(new Option(phrases[name][""], name));
  element("language").value = language;
}

function translatePage() {
  document.documentElement.lang = language;
  for (const node of document.querySelectorAll("[data-text]")) node.textContent = phrase(node.dataset.text);
  for (const node of document.querySelectorAll("[data-label]")) {
    const text = phrase(node.dataset.label);
    node.setAttribute("aria-label", text);
    if (node.tagName === "BUTTON") node.title = text;
  }
}

// A number with its unit.
function measured(value, units, digits = 3) {
  return `${show(value, digits)} ${unit(units)}`;
}

// ---- the scene in words

// Size and direction of a force, and its moment; empty at round-off level.
function arrowInWords(arrow, t) {
  const [fx, fy, , , couple] = valuesAt(arrow.arrow, t), size = Math.hypot(fx, fy), said = [];
  const way = phrase("directions").split(",")[(Math.round(Math.atan2(fy, fx) / (Math.PI / 4)) + 8) % 8];
  if (size > roundingOf(run.units.force)) said.push(`${measured(size, run.units.force)} ${way}`);
  if (Math.abs(couple) > roundingOf(run.units.moment)) said.push(`${phrase("moment")} ${measured(couple, run.units.moment)}`);
  return said.length ? `${quantity(arrow.name)} ${said.join(", ")}` : "";
}

function bodyInWords(body, t) {
  const numbers = [...body.coordinates, ...body.rates].map((c) => `${quantity(run.columns[c].n)} = ${measured(readAt(c, t), run.columns[c].u)}`);
  const acting = body.arrows.map((arrow) => arrowInWords(arrow, t)).filter(Boolean);
  return `${body.name}: ${numbers.join(", ")}. ${phrase("acting")} ${acting.join("; ") || phrase("nothing")}.`;
}

// The bodies with their forces, and the events before and after the time t.
function sceneInWords(t, bodies) {
  const next = eventTimes.findIndex((time) => time > t), last = (next < 0 ? eventTimes.length : next) - 1;
  const said = [phrase("at-time", show(t)), ...bodies.slice(0, fewBodies).map((body) => bodyInWords(body, t))];
  if (bodies.length > fewBodies) said.push(phrase("more-bodies", bodies.length - fewBodies));
  if (last >= 0) said.push(phrase("last-event", eventText(last)));
  if (next >= 0) said.push(phrase("next-event", eventText(next)));
  return said.join(" ");
}
