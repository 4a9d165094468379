/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: how distributed loads are distributed.
 */
#include <math.h>
#include <stdlib.h>

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

double fbd_model_spread_density(const fbd_model *model, size_t body, size_t force, double s)
{
    const struct spread *spread = spread_at(model, body, force);
    if (!spread) return NAN;
    if (spread->force == 0) return 0;
    const double share = s / spread->length;
    const double w = spread->w ? expr_eval(spread->w, 0, &s, NULL)
                               : (1 - share) * spread->ends[0] + share * spread->ends[1];
    return w / spread->force;
}

size_t fbd_model_spread_ends(const fbd_model *model, size_t body, size_t force, double *ends, size_t room)
{
    enum { most_pieces = 1000 };
    const struct spread *spread = spread_at(model, body, force);
    double *cut = spread ? calloc(most_pieces + 1, sizeof *cut) : NULL;
    if (!cut) return 0;
    int pieces = spread->w ? pieces_cut(&spread->w, 1, 1, 0, spread->length, most_pieces, cut) : 1;
    if (!spread->w) cut[1] = spread->length;
    for (int i = 0; ends && i <= pieces && (size_t)i < room; i++) ends[i] = cut[i];
    free(cut);
    return pieces > 0 ? (size_t)pieces + 1 : 0;
}
