/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Coefficients of the Rosenbrock method Rodas5P and of its continuous extension of order 4.
 *
 * They are those of the form without products by the Jacobian (HNW II, IV.7), in which the unknowns are the
 * solutions u_i, i = 1 ... 8, of
 *     (I / (gamma h) - J) u_i = f(t + c_i h, g_i) + h d_i df/dt + sum_(j<i) (C_ij / h) u_j,
 *     g_i = y0 + sum_(j<i) a_ij u_j,     y1 = g_8 + u_8.
 * Indices are those of these formulas. Rows 7 and 8 of a are not listed as g_7 = g_6 + u_6 and g_8 = g_7 +
 * u_7; the method is stiffly accurate, c_6 = c_7 = c_8 = 1. Other coefficients that are not listed are zero.
 *
 * Sources: G. Steinebach, Construction of Rosenbrock-Wanner method Rodas5P and numerical benchmarks within
 * the Julia Differential Equations package, BIT Numer. Math. 63 (2023) 27, with the digits of the public
 * program OrdinaryDiffEq.jl. tests/unit/test_rodas5p.c checks them: all 17 order conditions, the stability
 * function, the conditions of the dense output, measured slopes.
 */
#ifndef FBD_INTEGRATE_RODAS5P_TABLE_H
#define FBD_INTEGRATE_RODAS5P_TABLE_H

enum { rodas5p_stages = 8 };

static const double rodas5p_gamma = 0.21193756319429014;

static const double rodas5p_c[rodas5p_stages + 1] = {
    [2] = 0.6358126895828704, /* 3 gamma */
    [3] = 0.4095798393397535, [4] = 0.9769306725060716, [5] = 0.4288403609558664, [6] = 1, [7] = 1, [8] = 1,
};

/* d_6 = d_7 = d_8 = 0. */
static const double rodas5p_d[rodas5p_stages + 1] = {
    [1] = 0.21193756319429014, [2] = -0.42387512638858027, [3] = -0.3384627126235924,
    [4] = 1.8046452872882734,  [5] = 2.325825639765069,
};

static const double rodas5p_a[7][rodas5p_stages + 1] = {
    [2] = {[1] = 3},
    [3] = {[1] = 2.849394379747939, [2] = 0.45842242204463923},
    [4] = {[1] = -6.954028509809101, [2] = 2.489845061869568, [3] = -10.358996098473584},
    [5] = {[1] = 2.8029986275628964,
           [2] = 0.5072464736228206,
           [3] = -0.3988312541770524,
           [4] = -0.04721187230404641},
    [6] = {[1] = -7.502846399306121,
           [2] = 2.561846144803919,
           [3] = -11.627539656261098,
           [4] = -0.18268767659942256,
           [5] = 0.030198172008377946},
};

static const double rodas5p_C[rodas5p_stages + 1][rodas5p_stages + 1] = {
    [2] = {[1] = -14.155112264123755},
    [3] = {[1] = -17.97296035885952, [2] = -2.859693295451294},
    [4] = {[1] = 147.12150275711716, [2] = -1.41221402718213, [3] = 71.68940251302358},
    [5] = {[1] = 165.43517024871676,
           [2] = -0.4592823456491126,
           [3] = 42.90938336958603,
           [4] = -5.961986721573306},
    [6] = {[1] = 24.854864614690072,
           [2] = -3.0009227002832186,
           [3] = 47.4931110020768,
           [4] = 5.5814197821558125,
           [5] = -0.6610691825249471},
    [7] = {[1] = 30.91273214028599,
           [2] = -3.1208243349937974,
           [3] = 77.79954646070892,
           [4] = 34.28646028294783,
           [5] = -19.097331116725623,
           [6] = -28.087943162872662},
    [8] = {[1] = 37.80277123390563,
           [2] = -3.2571969029072276,
           [3] = 112.26918849496327,
           [4] = 66.9347231244047,
           [5] = -40.06618937091002,
           [6] = -54.66780262877968,
           [7] = -9.48861652309627},
};

/* Dense output: y(t0 + theta h) = y0 + theta (y1 - y0 + (1 - theta) (e_0 + theta (e_1 + theta e_2))) with e_m
 * = sum_j H_mj u_j. */
static const double rodas5p_h[3][rodas5p_stages + 1] = {
    {[1] = 25.948786856663858,
     [2] = -2.5579724845846235,
     [3] = 10.433815404888879,
     [4] = -2.3679251022685204,
     [5] = 0.524948541321073,
     [6] = 1.1241088310450404,
     [7] = 0.4272876194431874,
     [8] = -0.17202221070155493},
    {[1] = -9.91568850695171,
     [2] = -0.9689944594115154,
     [3] = 3.0438037242978453,
     [4] = -24.495224566215796,
     [5] = 20.176138334709044,
     [6] = 15.98066361424651,
     [7] = -6.789040303419874,
     [8] = -6.710236069923372},
    {[1] = 11.419903575922262,
     [2] = 2.8879645146136994,
     [3] = 72.92137995996029,
     [4] = 80.12511834622643,
     [5] = -52.072871366152654,
     [6] = -59.78993625266729,
     [7] = -0.15582684282751913,
     [8] = 4.883087185713722},
};

#endif
