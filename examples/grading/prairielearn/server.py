# SPDX-License-Identifier: GPL-3.0-or-later
"""The values of a variant, and the sheet with them."""
import pathlib
import random
import re


def generate(data):
    draw = random.Random(data["variant_seed"])
    values = {"L": f"{draw.randint(5, 15) / 10} m", "m": f"{draw.randint(1, 5)} kg", "beta": f"{draw.randint(10, 40)} deg"}
    sheet = pathlib.Path(data["options"]["question_path"], "sheet.yaml").read_text(encoding="utf-8")
    for name, value in values.items():
        sheet = re.sub(rf"(?m)^  {name}: .*", f"  {name}: {value}", sheet)
    data["params"]["values"] = values
    data["params"]["sheet"] = sheet
