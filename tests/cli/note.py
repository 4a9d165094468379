#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: note.py: calculation notes of models of different kinds, in each form. Prints TAP."""
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

RUN = os.environ["FBD_RUN"]
MODELS = Path(os.environ["FBD_SOURCE_ROOT"]) / "models"
NOTED = ["kinetics/incline", "statics/ladder", "couplings/slider_crank", "contact/bouncing_ball", "kinetics/drop_us", "data/measured_push"]
SECTIONS = ["System", "Assumptions", "Data", "Free-body diagrams", "Equations", "Results", "Events", "State at the end",
            "Forces at the end", "Energy", "Checks", "Limits", "Appendix: the model file"]
SIZES = {"k": 1e3, "M": 1e6}
checks = failures = 0


def check(claim, met, said=""):
    global checks, failures
    checks += 1
    failures += not met
    print(f"{'ok' if met else 'not ok'} {checks} - {claim}")
    if not met and said:
        print("\n".join(f"# {line}" for line in str(said).splitlines()[:20]))


def run(*arguments, **environment):
    return subprocess.run([RUN, "--quiet", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          env={**os.environ, **environment}, check=False)


# ---- reading

def tables(page):
    """Of an HTML note: caption -> rows of texts."""
    found = {}
    for table in page.iter("table"):
        caption = "".join(table.find("caption").itertext()).split(": ", 1)[1]
        found[caption] = [["".join(cell.itertext()) for cell in row] for row in table.find("tbody")]
    return found


def markdown_tables(text):
    """The same of a note in Markdown."""
    found = {}
    for caption, body in re.findall(r"^Table \d+: (.*)\n\n\|.*\n\| .*\n((?:\|.*\n)*)", text, re.M):
        rows = [[re.sub(r"\\(.)", r"\1", cell.strip()) for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in body.splitlines()]
        found[re.sub(r"\\(.)", r"\1", caption)] = rows
    return found


def value(text):
    """A number as it is printed, and half a unit of its last digit, in coherent units."""
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
    number, power, unit = re.fullmatch(r"([−]?[\d.]+)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?\s*(.*)", text.replace("\u00a0", " ")).groups()
    size = 10.0 ** int((power or "⁰").translate(raised))
    if re.match(r"[kM](N|J|W)", unit):
        size *= SIZES[unit[0]]
    if unit == "mm":
        size *= 1e-3
    last = 10.0 ** -len(number.partition(".")[2])
    return float(number.replace("−", "-")) * size, 0.5 * last * size


def agrees(text, expected, error):
    """A printed number is that of the JSON, rounded; within its error bar it may be printed as 0."""
    number, half = value(text)
    return abs(number - expected) <= half * (1 + 1e-9) or (number == 0 and abs(expected) <= (error or 0))


GREEK = {"θ": "theta", "ω": "omega"}


def plain(name):
    return re.sub("|".join(GREEK), lambda letter: GREEK[letter[0]], name)


def final_agrees(rows, result):
    wrong = []
    for name, text, _ in rows:
        body, last = plain(name).split(".")
        if not agrees(text, result["final"][body][last], result["final_error"][body][last]):
            wrong.append((name, text, result["final"][body][last]))
    return wrong


def events_agree(rows, result):
    if len(rows) != min(len(result["events"]), 60):
        return [("count", len(rows), len(result["events"]))]
    return [(row, event["t"]) for row, event in zip(rows, result["events"]) if not agrees(row[0], event["t"], event["t_error"])]


def energies_agree(rows, result):
    keys = {"kinetic": ("initial_kinetic", "kinetic"), "potential": ("initial_potential", "potential"), "work of the others": (None, "work")}
    wrong = []
    for name, first, last, _ in rows:
        start, end = keys[name]
        if start and not agrees(first, result["energy"][start], 0) or not agrees(last, result["energy"][end], result["energy_error"][end]):
            wrong.append((name, first, last))
    return wrong


# ---- forms

def check_html(model, file, result):
    text = file.read_text(encoding="utf-8")
    page = ElementTree.fromstring(text.replace("<!DOCTYPE html>", ""))
    headings = ["".join(each.itertext()) for each in page.iter() if each.tag in ("h2", "h3")]
    check(f"{model}: HTML is well formed, with its sections", [s for s in SECTIONS if s not in headings] == [], headings)
    ids = re.findall(r' id="([^"]*)"', text)
    check(f"{model}: each id stands once", len(ids) == len(set(ids)), ids)
    check(f"{model}: it loads nothing", not re.search(r"<script|<link|<img|src=|href=|@import|url\(|https?://(?!www\.w3\.org)", text))
    drawings = [each for each in page.iter("{http://www.w3.org/2000/svg}svg")]
    check(f"{model}: each drawing has a text in its place", drawings and all(each.get("aria-label") for each in drawings))
    check(f"{model}: no dark background", "prefers-color-scheme" not in text)
    found = tables(page)
    final = next(rows for caption, rows in found.items() if caption.startswith("coordinates and rates at"))
    wrong = final_agrees(final, result)
    check(f"{model}: the state at the end is that of --json", len(final) > 1 and not wrong, wrong)
    wrong = events_agree(found.get("events", []), result)
    check(f"{model}: the times of the events are those of --json", not wrong, wrong)
    wrong = energies_agree(found["energies, and the work of forces without a potential"], result)
    check(f"{model}: the energies are those of --json", not wrong, wrong)
    verdicts = [row[-1] for row in found["checks"]]
    check(f"{model}: each check is met", len(verdicts) >= 4 and set(verdicts) == {"yes"}, found["checks"])
    hashes = [cell for row in found["identification"] for cell in row if "SHA" in row[0] or "SHA" in cell]
    files = [MODELS / f"{model}.yaml"] + [MODELS.parent / data["file"] for data in result["model"]["data"]]
    digits = [hashlib.sha256(each.read_bytes()).hexdigest() for each in files]
    check(f"{model}: it has the hashes of its files", all(any(d in cell for cell in hashes) for d in digits), hashes)
    return found


def check_markdown(model, file, found):
    text = file.read_text(encoding="utf-8")
    check(f"{model}: Markdown has its sections", all(re.search(rf"^###? {re.escape(s)}$", text, re.M) for s in SECTIONS))
    drawings = re.findall(r"^!\[.+\]\(<(.*)>\)$", text, re.M)
    check(f"{model}: with its drawings beside it", drawings and all((file.parent / each).read_text(encoding="utf-8").startswith("<?xml")
                                                                   for each in drawings), drawings)
    wrong = [caption for caption, rows in markdown_tables(text).items() if rows != [[" ".join(c.split()) if c != c.strip() else c for c in row]
                                                                                    for row in found.get(caption, [])]]
    check(f"{model}: and the tables of the HTML", len(markdown_tables(text)) == len(found) and not wrong, wrong)


def check_latex(model, file):
    text = file.read_text(encoding="utf-8")
    begun, ended = re.findall(r"\\begin{(\w+\*?)}", text), re.findall(r"\\end{(\w+\*?)}", text)
    check(f"{model}: LaTeX has its sections", all(f"section*{{{s}}}" in text for s in SECTIONS))
    check(f"{model}: whatever is begun ends", begun and sorted(begun) == sorted(ended))
    check(f"{model}: in plain characters, or those of Latin letters", all(ord(c) < 0x180 for c in text), [c for c in text if ord(c) >= 0x180])
    drawings = re.findall(r"\\includegraphics\[[^]]*\]{([^}]*)}", text)
    check(f"{model}: with its drawings as PDF", drawings and all((file.parent / each).read_bytes().startswith(b"%PDF") for each in drawings))


def check_forms(folder, converts):
    for model in NOTED:
        path, name = MODELS / f"{model}.yaml", model.split("/")[1]
        done = run("--note", folder / f"{name}.html", "--json", folder / f"{name}.json", path)
        check(f"{model}: a note", done.returncode == 0 and not done.stderr, done.stderr)
        found = check_html(model, folder / f"{name}.html", json.loads((folder / f"{name}.json").read_text()))
        check(f"{model}: in Markdown", run("--note", folder / f"{name}.md", path).returncode == 0)
        check_markdown(model, folder / f"{name}.md", found)
        if converts:
            check(f"{model}: in LaTeX", run("--note", folder / f"{name}.tex", path).returncode == 0)
            check_latex(model, folder / f"{name}.tex")


def check_numbers(folder):
    """Prefixes, and zeros at the round-off level."""
    heavy = folder / "heavy.yaml"
    heavy.write_text("fbd: 1\nbodies:\n  b: {mass: 2 t, motion: slide, initial: {v: 4 mm/s}, forces: [gravity, normal, friction: 0.5]}\n"
                     "simulate: {until: 1 s}\n")
    check("a heavy body", run("--note", folder / "heavy.html", heavy).returncode == 0)
    text = (folder / "heavy.html").read_text(encoding="utf-8").replace("\u00a0", " ")
    for words in ["Fx [kN]", "<td class=\"r\">19.62</td>"]:
        check(f"has `{words}`", words in text)
    check("degrees", run("--degrees", "--note", folder / "deg.html", MODELS / "statics/ladder.yaml").returncode == 0)
    check("are degrees", ">60°<" in (folder / "deg.html").read_text(encoding="utf-8"))


def check_days(folder):
    path = MODELS / "kinetics/incline.yaml"
    for name in ("one.html", "two.html"):
        run("--note", folder / name, "--set", "mu_k=0.4", path, SOURCE_DATE_EPOCH="86400")
    one = (folder / "one.html").read_text(encoding="utf-8")
    check("the day is that of SOURCE_DATE_EPOCH", ">1970-01-02<" in one)
    check("the same note twice", one == (folder / "two.html").read_text(encoding="utf-8"))
    check("with the settings", ">mu_k = 0.4<" in one)


def check_mistakes(folder):
    path, before = MODELS / "kinetics/incline.yaml", sorted(folder.iterdir())
    for file in ("note.doc", "note", "note.html.txt", "-", "a b.md", "a$b.tex"):
        done = run("--note", folder / file if file != "-" else file, path)
        check(f"--note {file} is refused", done.returncode == 2 and "--note" in done.stderr, done.stderr)
    for others in (["--equations"], ["--static"], ["--without", "block.friction"], ["--check"]):
        check(f"--note with {others[0]} is refused", run("--note", folder / "n.html", *others, path).returncode == 2)
    done = run("--note", folder / "n.pdf", path, PATH="/nowhere")
    check("a PDF needs a program", done.returncode == 2 and "chromium" in done.stderr and "texlive" in done.stderr, done.stderr)
    check("LaTeX needs a converter", run("--note", folder / "n.tex", path, PATH="/nowhere").returncode == 2)
    for model, code in (("hard/singular_reached", 1), ("hard/not_a_number_beyond", 1)):
        for end in ("html", "md"):
            check(f"a run that fails has no note ({model}, {end})", run("--note", folder / f"n.{end}", MODELS / f"{model}.yaml").returncode == code)
    wrong = folder / "wrong.yaml"
    wrong.write_text("fbd: 1\nbodies:\n  b: {mass: 1, motion: slides}\n")
    check("a wrong model has none", run("--note", folder / "n.html", wrong).returncode == 3)
    wrong.unlink()
    check("and no file is left", sorted(folder.iterdir()) == before, sorted(folder.iterdir()))
    check("no folder, no note", run("--note", folder / "none" / "n.md", path).returncode == 1)


def check_refusals(folder):
    """A derivation that is wrong is a check that is not met."""
    text = (MODELS / "kinetics/incline.yaml").read_text(encoding="utf-8").replace('"N = m*g*cos(phi)"', '"N = m*g*sin(phi)"')
    (folder / "hand.yaml").write_text(text, encoding="utf-8")
    done = run("--note", folder / "hand.html", folder / "hand.yaml")
    check("a wrong derivation: 5", done.returncode == 5 and "1 of " in done.stderr, done.stderr)
    rows = tables(ElementTree.fromstring((folder / "hand.html").read_text(encoding="utf-8").replace("<!DOCTYPE html>", "")))["checks"]
    check("it is in the note", [row[-1] for row in rows if row[0].startswith("derivations")] == ["NO"], rows)
    done = run("--note", folder / "broken.html", MODELS / "kinetics/crate_tips.yaml") if (MODELS / "kinetics/crate_tips.yaml").exists() else None
    check("a run that ends early says why", done is None or "The run ended early" in (folder / "broken.html").read_text(encoding="utf-8"))


def check_markup(folder):
    """Titles and names are data, never markup."""
    (folder / "odd.yaml").write_text('fbd: 1\ntitle: "<b>&amp; 50 % of $x_1$ | #\\\\end{document} `\\u202e`"\nbodies:\n'
                                     "  b: {mass: 1, motion: slide, initial: {v: 1}}  # ``` </pre> \\end{verbatim}\nsimulate: {until: 1}\n")
    for end in ("html", "md", "tex"):
        if end != "tex" or shutil.which("rsvg-convert"):
            check(f"an odd title in {end}", run("--note", folder / f"odd.{end}", folder / "odd.yaml").returncode == 0)
    page = ElementTree.fromstring((folder / "odd.html").read_text(encoding="utf-8").replace("<!DOCTYPE html>", ""))
    title = "".join(page.find("body/main/h1").itertext())
    check("is text in HTML", "<b>&amp; 50 % of $x_1$" in title and "\\u202e" in title, title)
    if (folder / "odd.tex").exists():
        check("and in LaTeX", (folder / "odd.tex").read_text(encoding="utf-8").count("\\end{document}") == 1)


def check_pdf(folder):
    if not (shutil.which("chromium") or (shutil.which("pdflatex") and shutil.which("rsvg-convert"))):
        print("# neither chromium nor LaTeX is installed: PDF is left out")
        return
    done = run("--note", folder / "n.pdf", MODELS / "kinetics/incline.yaml", TMPDIR=str(folder))
    check("PDF", done.returncode == 0, done.stderr)
    check("is one", (folder / "n.pdf").read_bytes().startswith(b"%PDF"))
    check("its folder is removed", not list(folder.glob("fbd-note-*")))


def main():
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        os.chdir(MODELS.parent)
        check_forms(folder, shutil.which("rsvg-convert") or shutil.which("inkscape"))
        for part in (check_numbers, check_days, check_mistakes, check_refusals, check_markup, check_pdf):
            part(folder)
    print(f"1..{checks}")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
