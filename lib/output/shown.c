/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/shown.h"

#include <string.h>

struct shown shown_in_degrees(struct shown shown, bool degrees)
{
    const bool angle = strcmp(shown.unit, "rad") == 0, rate = strcmp(shown.unit, "rad/s") == 0;
    if (!degrees || !(angle || rate)) return shown;
    return (struct shown){shown.name, angle ? "deg" : "deg/s", 3.14159265358979323846 / 180};
}

struct shown shown_component(const struct fbd_model *model, size_t index, bool degrees)
{
    const size_t n = (size_t)model->plan.n;
    if (index >= 2 * n)
        return (struct shown){model->own_labels[index - 2 * n].name, model->own_labels[index - 2 * n].unit,
                              1};
    const bool rate = index >= n;
    const struct label *label = &model->labels[index % n];
    struct shown shown = {rate ? label->rate_name : label->name, rate ? label->rate_unit : label->unit, 1};
    return shown_in_degrees(shown, degrees);
}
