"use strict";

// At the end of a page that `fbd-run --watch` rewrites, which calls fbd.live(stamp) behind it. The page then polls
// PAGE.stamp.js, which calls fbd.stamp with the stamp of the last run, and reloads if that differs, keeping time and view.

const liveChoices = [...choices.map((name) => `show-${name}`), "follow", "loop"];
const live = { own: "", timer: 0, place: `fbd ${location.pathname}` };

function liveKept() {
  try { return JSON.parse(sessionStorage.getItem(live.place)) || {}; } catch { return {}; }
}

function keepView(stamp) {
  const whole = plotWindow.from === run.start && plotWindow.to === run.end;
  const kept = { stamp, t: player.t, playing: player.playing, speed: player.speed, language, body: chosenBody() === null ? null : chosenBodies()[0].name,
    shows: liveChoices.map((id) => element(id).checked), zoom: whole ? null : [plotWindow.from, plotWindow.to], scroll: scrollY };
  try { sessionStorage.setItem(live.place, JSON.stringify(kept)); } catch { return false; }
  return true;
}

function takeView(kept) {
  if (kept.t === undefined) return;
  const body = run.bodies.findIndex((other) => other.name === kept.body);
  element("body").value = String(kept.body === null ? allBodies : Math.max(body, 0));
  makeDetails(chosenBodies());
  liveChoices.forEach((id, i) => { element(id).checked = kept.shows[i]; });
  fit();
  if (kept.zoom) setWindow(Math.max(kept.zoom[0], run.start), Math.min(kept.zoom[1], run.end));
  changeLanguage(kept.language);
  setSpeed(kept.speed);
  seek(kept.t);
  setPlaying(kept.playing);
  scrollTo(0, kept.scroll);
}

function requestStamp() {
  const script = document.createElement("script");
  script.src = `${location.pathname.split("/").pop()}.stamp.js?${Date.now()}`;
  script.onload = () => script.remove();
  script.onerror = () => { script.remove(); clearInterval(live.timer); }; // the watch has ended
  document.head.append(script);
}

window.fbd.live = (own) => {
  live.own = own;
  takeView(liveKept());
  live.timer = setInterval(requestStamp, 500);
};

// Do not reload again for a stamp after which the page is still the old one, to avoid an endless loop.
window.fbd.stamp = (stamp) => {
  if (stamp === live.own || stamp === liveKept().stamp || !keepView(stamp)) return;
  clearInterval(live.timer);
  location.reload();
};
