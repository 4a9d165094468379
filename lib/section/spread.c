/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: how distributed loads are distributed.
 */
#include "section/spread.h"

#include <math.h>

#include "expr/pieces.h"
#include "fbd_section.h"
#include "model/model.h"

static const struct spread *spread_at(const fbd_model *model, size_t body, size_t force)
{
    if (!model || body >= model->body_count || force >= model->bodies[body].source->load_count) return NULL;
    const struct spread *spread = &model->bodies[body].source->loads[force].spread;
    return spread->length > 0 ? spread : NULL;
}

fbd_spread fbd_model_spread(const fbd_model *model, size_t body, size_t force)
{
    const struct spread *spread = spread_at(model, body, force);
    if (!spread) return (fbd_spread){{NAN, NAN}, {NAN, NAN}, 0};
    return (fbd_spread){{spread->from.x, spread->from.y}, {spread->to.x, spread->to.y}, spread->length};
}

double spread_density(const struct spread *spread, double s)
{
    if (spread->force == 0) return 0;
    const double share = s / spread->length;
    const double w = spread->w ? expr_eval(spread->w, 0, &s, NULL)
                               : (1 - share) * spread->ends[0] + share * spread->ends[1];
    return w / spread->force;
}

double fbd_model_spread_density(const fbd_model *model, size_t body, size_t force, double s)
{
    const struct spread *spread = spread_at(model, body, force);
    return spread ? spread_density(spread, s) : NAN;
}

size_t spread_ends(const struct spread *spread, double ends[spread_most_ends])
{
    ends[0] = 0;
    ends[1] = spread->length;
    if (!spread->w) return 2;
    const int pieces = pieces_cut(&spread->w, 1, 1, 0, spread->length, spread_most_ends - 1, ends);
    return pieces > 0 ? (size_t)pieces + 1 : 0;
}

size_t fbd_model_spread_ends(const fbd_model *model, size_t body, size_t force, double *ends, size_t room)
{
    const struct spread *spread = spread_at(model, body, force);
    double all[spread_most_ends];
    const size_t count = spread ? spread_ends(spread, all) : 0;
    for (size_t i = 0; ends && i < count && i < room; i++) ends[i] = all[i];
    return count;
}
