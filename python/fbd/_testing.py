# SPDX-License-Identifier: GPL-3.0-or-later
"""For tests of hand derivations by pytest or unittest."""
from __future__ import annotations

import os
from typing import Any, Union

from ._model import Model


def assert_derivation(model: Union[Model, str, "os.PathLike[str]"], /, *, seed: int = 1, **parameters: Any) -> None:
    """Assert that every ``hand:`` derivation of a model, or of a model file, agrees with the assembly.

    What differs, and in which term, is the text of the AssertionError; a model without a derivation has none that
    agrees.

    >>> def test_block():
    ...     fbd.assert_derivation("block.yaml")
    """
    __tracebackhide__ = True
    if isinstance(model, Model):
        if parameters:
            raise TypeError("parameters are those of a file, not of a model that is there already")
    else:
        model = Model(model, **parameters)
    check = model.check_hand(seed)
    if check:
        raise AssertionError(check.text)
    if check.text.startswith("no body carries"):
        raise AssertionError("no body carries a `hand:` derivation")
