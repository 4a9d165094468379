# SPDX-License-Identifier: GPL-3.0-or-later
"""The template of a CodeRunner question: a combinator, with a template grader. Twig puts the answer into it."""
import html
import json

from grade_one import grade

with open("answer.yaml", "w", encoding="utf-8") as file:
    file.write("""{{ STUDENT_ANSWER | e('py') }}""")
result = grade("key.yaml", "answer.yaml", """{{ STUDENT.username | e('py') }}""")
rows = [[int(test["kind"] == "right"), test["name"], test["message"], f"{test['points']:g} of {test['max_points']:g}"]
        for test in result["tests"]]
print(json.dumps({
    "fraction": min(1, max(0, result["score"])),
    "prologuehtml": f"<p>{html.escape(result['message'])}</p>" if result["message"] else "",
    "testresults": [["iscorrect", "Part", "Finding", "Points"], *rows],
}))
