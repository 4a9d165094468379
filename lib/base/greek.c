/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/greek.h"

#include <string.h>

static const struct greek {
    const char *name, *letter;
} greek[] = {
    {"alpha", "α"}, {"beta", "β"}, {"gamma", "γ"}, {"delta", "δ"}, {"theta", "θ"}, {"lambda", "λ"},
    {"mu", "μ"},    {"phi", "φ"},  {"psi", "ψ"},   {"omega", "ω"}, {"rho", "ρ"},   {"tau", "τ"},
};

const char *greek_letter(const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strlen(greek[i].name) == length && memcmp(greek[i].name, name, length) == 0) return greek[i].letter;
    return NULL;
}
