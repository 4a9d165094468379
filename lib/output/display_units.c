/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/display_units.h"

#include <string.h>

struct display display_in_degrees(struct display display, bool degrees)
{
    const bool angle = strcmp(display.unit, "rad") == 0, rate = strcmp(display.unit, "rad/s") == 0;
    if (!degrees || !(angle || rate)) return display;
    return (struct display){display.name, angle ? "deg" : "deg/s", 3.14159265358979323846 / 180};
}

struct display display_of_component(const struct fbd_model *model, size_t index, bool degrees)
{
    const size_t n = (size_t)model->plan.n;
    if (index >= 2 * n)
        return (struct display){model->own_labels[index - 2 * n].name, model->own_labels[index - 2 * n].unit,
                                1};
    const bool rate = index >= n;
    const struct label *label = &model->labels[index % n];
    struct display display = {rate ? label->rate_name : label->name, rate ? label->rate_unit : label->unit,
                              1};
    return display_in_degrees(display, degrees);
}
