"use strict";

// The texts of live pages, all of them in live-texts.json, beside those of every page.

const livePhrases = JSON.parse(JSON.parse(element("live-parts").textContent)["live-texts.json"]);
for (const name of Object.keys(phrases)) Object.assign(phrases[name], livePhrases[name]);
