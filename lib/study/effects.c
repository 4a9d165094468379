/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fbd.h"
fbd_effects *fbd_effects_new(const fbd_model *m, const fbd_cost_options *o, fbd_errors *e){(void)m;(void)o;(void)e;return NULL;}
void fbd_effects_free(fbd_effects *e){(void)e;}
char *fbd_effects_text(const fbd_effects *e){(void)e;return NULL;}
char *fbd_effects_csv(const fbd_effects *e){(void)e;return NULL;}
char *fbd_effects_json(const fbd_effects *e){(void)e;return NULL;}
