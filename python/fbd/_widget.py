# SPDX-License-Identifier: GPL-3.0-or-later
"""Sliders for notebooks, by ipywidgets."""
from __future__ import annotations

import html
import importlib
import math
import os
from typing import TYPE_CHECKING, Any, Callable, Dict, Optional

from ._notes import Error, complaint

if TYPE_CHECKING:
    from ._model import Model


def _ipywidgets() -> Any:
    try:
        return importlib.import_module("ipywidgets")
    except ImportError:
        raise ImportError("sliders need ipywidgets: `apt install python3-ipywidgets`, or `pip install ipywidgets`") from None


class Sliders:
    """A slider for each parameter of the file that has a ``range``, above what is shown of the model with these values
    (:meth:`fbd.Model.sliders`). ``values`` maps names to numbers in the model's units, ``model`` is the present model, and
    ``shown`` what was shown last.
    """

    def __init__(self, model: "Model", show: Optional[Callable[["Model"], Any]]):
        widgets = _ipywidgets()
        self._file, self._source = model, model._read_again().decode("utf-8")
        self._show: Callable[["Model"], Any] = show if show is not None else (lambda now: now.run())
        ranged = {name: each for name, each in model.parameters.items()
                  if not each.derived and math.isfinite(each.low) and math.isfinite(each.high)}
        if not ranged:
            raise Error((complaint("error", "no-range", "no parameter of the file has a `range`, as in `mu: {value: 0.3, range: [0, 1]}`"),))
        self._sliders: Dict[str, Any] = {
            name: widgets.FloatSlider(value=each.value, min=each.low, max=each.high, step=(each.high - each.low) / 100,
                                      description=f"{name} [{each.unit}]" if each.unit else name, continuous_update=False,
                                      readout_format=".4g")
            for name, each in ranged.items()}
        self._picture = widgets.HTML()
        self.widget = widgets.VBox([*self._sliders.values(), self._picture])
        self.model: "Model" = model
        self.shown: Any = None
        self._draw()
        for slider in self._sliders.values():
            slider.observe(lambda change: self._move(), names="value")

    @property
    def values(self) -> Dict[str, float]:
        """The present values."""
        return {name: float(slider.value) for name, slider in self._sliders.items()}

    def _move(self) -> None:
        file = self._file
        try:
            self.model = type(file).parse(self._source, os.fsdecode(file._name), **{**file._parameters, **self.values})
            self._draw()
        except Error as error:
            self._picture.value = f"<pre>{html.escape(str(error))}</pre>"

    def _draw(self) -> None:
        self.shown = self._show(self.model)
        page = hasattr(self.shown, "_repr_html_")
        self._picture.value = self.shown._repr_html_() if page else f"<pre>{html.escape(str(self.shown))}</pre>"

    def _ipython_display_(self) -> None:
        importlib.import_module("IPython.display").display(self.widget)

    def __repr__(self) -> str:
        return f"<fbd.Sliders {', '.join(f'{name} = {value:.6g}' for name, value in self.values.items())}>"
