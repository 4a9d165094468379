/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/closed_loops.h"

#include <float.h>
#include <string.h>

#include "base/sine.h"

/* Roundings that are left as they are, see the header: of gaps and rates of the pins at the end of a step, and
 * within it; and of accelerations of the pins, which include those of such gaps and rates. */
static const double at_ends = 4 * DBL_EPSILON, within = 16 * DBL_EPSILON, of_accelerations = 64 * DBL_EPSILON;

/* A smaller share of a determinant is near a singular position. */
static const double well = 0.03;

/* ---- the scene */

/* The joints between the two links of a pin: those below both move its points alike. With `arms` (else NULL)
 * they are written. Returns their number. */
static int find_arms(const struct tree *tree, const struct coupling *pin, struct loop_arm *arms)
{
    int count = 0, link[2] = {pin->end[0].link, pin->end[1].link};
    while (link[0] != link[1]) {
        int end = link[1] > link[0];
        if (arms) arms[count] = (struct loop_arm){link[end], end, {0, 0}};
        link[end] = tree->links[link[end]].parent;
        count++;
    }
    return count;
}

static bool has_simple_joints(const struct tree *tree)
{
    for (int i = 1; i < tree->joined; i++)
        if (tree->links[i].kind != motion_pivot && tree->links[i].kind != motion_slide) return false;
    return tree->joined_watched == 0 && tree->bulk_count == 0;
}

static bool has_pins_only(const struct tree *tree)
{
    for (int k = 0; k < tree->coupling_count; k++)
        if (tree->couplings[k].kind != constraint_pin || find_arms(tree, &tree->couplings[k], NULL) < 2)
            return false;
    return tree->coupling_count > 0 && tree->meeting_count == 0;
}

static size_t arm_count(const struct tree *tree)
{
    size_t count = 0;
    for (int k = 0; k < tree->coupling_count; k++)
        count += (size_t)find_arms(tree, &tree->couplings[k], NULL);
    return count;
}

size_t closed_loops_size(const struct fbd_model *model)
{
    const struct tree *tree = model->tree;
    /* Rows of other bodies and of user states know no positions in the world. */
    const bool others = tree->joined < tree->count || model->plan.own > 0;
    if ((model->names_places && others) || tree->ends || tree->massless_count > 0 ||
        !has_simple_joints(tree) || !has_pins_only(tree))
        return 0;
    int independent = tree->joined - 1 - 2 * tree->coupling_count;
    if (independent < 1 || independent > most_independent) return 0;
    size_t links = (size_t)tree->joined, bases = (size_t)independent;
    size_t size = (size_t)tree->coupling_count * sizeof(struct loop_pin) +
                  arm_count(tree) * sizeof(struct loop_arm) + (4 + bases) * links * sizeof(double) +
                  (1 + bases) * links * sizeof(struct acceleration) + links * sizeof(bool);
    return (size + sizeof(double) - 1) / sizeof(double) * sizeof(double);
}

/* The inertia of each joint with all links behind it, in the position where they reach farthest. */
static void set_units(const struct tree *tree, double *mass, double *unit)
{
    for (int i = 0; i < tree->joined; i++) {
        mass[i] = tree->links[i].mass;
        unit[i] = tree->links[i].I_O;
    }
    for (int i = tree->joined - 1; i > 0; i--) {
        const struct tree_link *link = &tree->links[i];
        mass[link->parent] += mass[i];
        unit[link->parent] += mass[i] * vec_dot(link->at, link->at);
        double inertia = link->kind == motion_slide ? mass[i] : unit[i];
        unit[i] = inertia > 0 ? 1 / sqrt(inertia) : 0;
    }
}

void closed_loops_init(struct closed_loops *loops, const struct fbd_model *model, void *memory)
{
    const struct tree *tree = model->tree;
    size_t links = (size_t)tree->joined;
    *loops = (struct closed_loops){.tree = tree,
                                   .pins = memory,
                                   .pin_count = tree->coupling_count,
                                   .independent_count = tree->joined - 1 - 2 * tree->coupling_count,
                                   .chosen = -1};
    struct loop_arm *arms = (struct loop_arm *)(loops->pins + loops->pin_count);
    for (int k = 0; k < loops->pin_count; k++) {
        int count = find_arms(tree, &tree->couplings[k], arms);
        loops->pins[k] = (struct loop_pin){.coupling = &tree->couplings[k], .arms = arms, .count = count};
        arms += count;
    }
    loops->A = (struct acceleration *)arms;
    for (int k = 0; k < loops->independent_count; k++) loops->B[k] = loops->A + (size_t)(k + 1) * links;
    loops->unit = (double *)(loops->A + (size_t)(loops->independent_count + 1) * links);
    loops->q = loops->unit + links;
    loops->v = loops->q + links;
    loops->a = loops->v + links;
    for (int k = 0; k < loops->independent_count; k++) loops->basis[k] = loops->a + (size_t)(k + 1) * links;
    void *behind = loops->a + (size_t)(loops->independent_count + 1) * links;
    loops->known = behind;
    set_units(tree, loops->a, loops->unit);
}

/* ---- positions */

/* Set angles and points of the links at q; `near`: from those at another q nearby. */
static void place_links(const struct closed_loops *loops, struct tree_state *links, bool near)
{
    links[0].turn = (struct vec){1, 0};
    for (int i = 1; i < loops->tree->joined; i++) {
        const struct tree_link *link = &loops->tree->links[i];
        const struct tree_state *parent = &links[link->parent];
        struct tree_state *s = &links[i];
        struct vec at = link->at;
        double angle = parent->angle + link->along;
        if (link->kind == motion_pivot) {
            angle += loops->q[i];
            s->turn = near ? unit_turned_on(s->turn, s->angle, angle) : unit_by_sine(angle);
        } else {
            s->turn = vec_turn(parent->turn, link->tilt);
            s->e = vec_turn(parent->turn, link->e);
            at = vec_add(at, vec_scale(loops->q[i], link->e));
        }
        s->angle = angle;
        s->d = vec_turn(parent->turn, at);
        s->p = vec_add(parent->p, s->d);
    }
}

static struct vec slope_of(const struct tree_link *link, const struct tree_state *s, struct vec p)
{
    return link->kind == motion_pivot ? vec_perp(vec_sub(p, s->p)) : s->e;
}

/* Set the slopes of a pin's arms, for its points p, and take its determinant into the smallest share. */
static void set_slopes(struct closed_loops *loops, struct loop_pin *pin, const struct tree_state *links,
                       const struct vec *p)
{
    const struct loop_arm *a = pin->arms;
    double longest = 0;
    for (int i = 0; i < pin->count; i++) {
        struct loop_arm *arm = &pin->arms[i];
        double unit = loops->unit[arm->link];
        arm->slope = slope_of(&loops->tree->links[arm->link], &links[arm->link], p[arm->end]);
        if (arm->end == 1) arm->slope = vec_scale(-1, arm->slope);
        double size = unit * unit * vec_dot(arm->slope, arm->slope);
        if (size > longest) longest = size;
    }
    pin->determinant = vec_cross(a[0].slope, a[1].slope);
    double share = fabs(pin->determinant) * loops->unit[a[0].link] * loops->unit[a[1].link];
    if (!(share >= loops->share * longest)) loops->share = longest > 0 ? share / longest : 0;
}

/* Set the gaps of the pins and the slopes of their arms. Returns the largest gap in relation to the reach of
 * the pins. */
static double measure(struct closed_loops *loops, const struct tree_state *links)
{
    double gap = 0, reach = 0;
    loops->share = 1;
    for (int k = 0; k < loops->pin_count; k++) {
        struct loop_pin *pin = &loops->pins[k];
        struct vec p[2];
        for (int end = 0; end < 2; end++) {
            const struct tree_state *s = &links[pin->coupling->end[end].link];
            pin->r[end] = vec_turn(s->turn, pin->coupling->end[end].point);
            p[end] = vec_add(s->p, pin->r[end]);
        }
        pin->gap = vec_sub(p[0], p[1]);
        set_slopes(loops, pin, links, p);
        double own = fabs(pin->gap.x) + fabs(pin->gap.y), far = fabs(p[0].x) + fabs(p[0].y);
        if (!(own <= gap)) gap = own;
        if (far > reach) reach = far;
    }
    loops->reach = reach;
    return gap / reach;
}

/* Set the dependent numbers of x so that each pin moves by its `rest`. True if that is rounding for all pins. */
static bool substitute(const struct closed_loops *loops, double *x)
{
    bool rounding = true;
    for (int k = 0; k < loops->pin_count; k++) {
        const struct loop_pin *pin = &loops->pins[k];
        const struct loop_arm *a = pin->arms;
        struct vec rest = pin->rest;
        for (int i = 2; i < pin->count; i++) rest = vec_sub(rest, vec_scale(x[a[i].link], a[i].slope));
        if (fabs(rest.x) + fabs(rest.y) <= pin->level)
            rest = (struct vec){0, 0};
        else
            rounding = false;
        x[a[0].link] = vec_cross(rest, a[1].slope) / pin->determinant;
        x[a[1].link] = vec_cross(a[0].slope, rest) / pin->determinant;
    }
    return rounding;
}

/* Let each pin move by this share of its gap. */
static void set_rest(const struct closed_loops *loops, double share)
{
    for (int k = 0; k < loops->pin_count; k++) {
        loops->pins[k].rest = vec_scale(share, loops->pins[k].gap);
        loops->pins[k].level = 0;
    }
}

static void clear_independent(const struct closed_loops *loops, double *x)
{
    for (int k = 0; k < loops->independent_count; k++) x[loops->independent[k]] = 0;
}

/* Is another choice of dependent coordinates better? Slopes have changed since the last one. */
static void choose_again(struct closed_loops *loops)
{
    const double changed = 4;
    if (loops->chosen >= 0 &&
        (loops->held || loops->share >= well ||
         (loops->share * changed > loops->chosen && loops->share < loops->chosen * changed)))
        return;
    closed_loops_choose(loops);
    for (int k = 0; k < loops->pin_count; k++)
        loops->pins[k].determinant = vec_cross(loops->pins[k].arms[0].slope, loops->pins[k].arms[1].slope);
}

/* Move the dependent coordinates by one step of Newton's method. Returns the largest change, of an angle, or of a
 * position in relation to the reach. */
static double correct(struct closed_loops *loops)
{
    double *by = loops->a, most = 0;
    set_rest(loops, -1);
    clear_independent(loops, by);
    substitute(loops, by);
    for (int i = 1; i < loops->tree->joined; i++) {
        loops->q[i] += by[i];
        double size = loops->tree->links[i].kind == motion_pivot ? fabs(by[i]) : fabs(by[i]) / loops->reach;
        if (!(size <= most)) most = size;
    }
    return most;
}

/* Is the position well-conditioned, or the dependent coordinates in proportion to the independent ones? If not,
 * independent coordinates are given up for good: a step with both kinds of rates would not be smooth. */
static bool is_regular(struct closed_loops *loops)
{
    if (loops->share >= well || loops->even) return true;
    if (!loops->held) loops->unfit = true;
    return false;
}

/* Close the loops, unless the gaps are `rounding`: after each step of Newton's method the error is about the
 * square of the change. */
static bool close_gaps(struct closed_loops *loops, struct tree_state *links, double rounding)
{
    enum { most_steps = 6 };
    const double part = 0.1, squares_to_rounding = 1e-9;
    place_links(loops, links, false);
    double gap = measure(loops, links);
    choose_again(loops);
    for (int k = 0; k < most_steps && !loops->unfit; k++) {
        if (gap <= (loops->share >= well ? rounding : within)) return loops->share > within / loops->share;
        if (!is_regular(loops)) return false;
        double by = correct(loops);
        if (!(by <= part * loops->share)) return false;
        place_links(loops, links, true);
        gap = measure(loops, links);
        if (by <= squares_to_rounding) return true;
    }
    return false;
}

/* ---- rates */

/* Velocities of the links, and their accelerations when those of the joints are zero. */
static void move_links(const struct closed_loops *loops, struct tree_state *links)
{
    for (int i = 1; i < loops->tree->joined; i++) {
        const struct tree_link *link = &loops->tree->links[i];
        const struct tree_state *parent = &links[link->parent];
        struct tree_state *s = &links[i];
        double w = parent->omega;
        s->v = vec_add(parent->v, vec_scale(w, vec_perp(s->d)));
        s->A.a = vec_sub(parent->A.a, vec_scale(w * w, s->d));
        if (link->kind == motion_pivot) {
            s->omega = w + loops->v[i];
        } else {
            s->omega = w;
            s->v = vec_add(s->v, vec_scale(loops->v[i], s->e));
            s->A.a = vec_add(s->A.a, vec_scale(2 * w * loops->v[i], vec_perp(s->e)));
        }
    }
}

/* The accelerations of the links by those of the joints alone. */
static void accelerate_links(const struct closed_loops *loops, const struct tree_state *links,
                             const double *x, struct acceleration *A)
{
    A[0] = (struct acceleration){0, {0, 0}};
    for (int i = 1; i < loops->tree->joined; i++) {
        const struct tree_link *link = &loops->tree->links[i];
        A[i] = acceleration_at(A[link->parent], links[i].d);
        if (link->kind == motion_pivot)
            A[i].alpha += x[i];
        else
            A[i].a = vec_add(A[i].a, vec_scale(x[i], links[i].e));
    }
}

/* Do the velocities of the joints move the pins by rounding only? */
static bool has_rates(const struct closed_loops *loops, double rounding)
{
    for (int k = 0; k < loops->pin_count; k++) {
        const struct loop_pin *pin = &loops->pins[k];
        struct vec rate = {0, 0};
        double size = 0;
        for (int i = 0; i < pin->count; i++) {
            struct vec own = vec_scale(loops->v[pin->arms[i].link], pin->arms[i].slope);
            rate = vec_add(rate, own);
            size += fabs(own.x) + fabs(own.y);
        }
        if (!(fabs(rate.x) + fabs(rate.y) <= rounding / loops->share * size)) return false;
    }
    return true;
}

/* The columns of N. */
static void set_basis(const struct closed_loops *loops)
{
    set_rest(loops, 0);
    for (int k = 0; k < loops->independent_count; k++) {
        clear_independent(loops, loops->basis[k]);
        loops->basis[k][loops->independent[k]] = 1;
        substitute(loops, loops->basis[k]);
    }
}

/* Let the dependent rates follow, unless the rates of the pins are `rounding`. */
static void close_rates(const struct closed_loops *loops, double rounding)
{
    if (has_rates(loops, loops->share >= well ? rounding : within)) return;
    set_rest(loops, 0);
    substitute(loops, loops->v);
}

/* Accelerations of the joints that keep the pins closed, with the independent ones zero. True if they are
 * rounding. */
static bool set_particular(const struct closed_loops *loops, const struct tree_state *links)
{
    for (int k = 0; k < loops->pin_count; k++) {
        struct loop_pin *pin = &loops->pins[k];
        struct vec a[2];
        double size = 0;
        for (int end = 0; end < 2; end++) {
            const struct tree_state *s = &links[pin->coupling->end[end].link];
            struct vec own = vec_scale(s->omega * s->omega, pin->r[end]);
            size += fabs(own.x) + fabs(own.y) + fabs(s->A.a.x) + fabs(s->A.a.y);
            a[end] = vec_sub(s->A.a, own);
        }
        pin->rest = vec_sub(a[1], a[0]);
        pin->level = of_accelerations * size / (loops->share * loops->share);
    }
    clear_independent(loops, loops->a);
    bool rounding = substitute(loops, loops->a);
    accelerate_links(loops, links, loops->a, loops->A);
    return rounding;
}

/* Minus the wrench that a link lacks for these accelerations, about its O. */
static struct wrench lacking(const struct tree_link *link, const struct tree_state *s, struct acceleration A)
{
    struct vec a = vec_add(s->A.a, A.a);
    struct vec f = vec_add(vec_scale(link->mass, a), vec_scale(A.alpha, vec_perp(s->mr)));
    f = vec_sub(f, vec_scale(s->omega * s->omega, s->mr));
    double moment = vec_cross(s->mr, a) + link->I_O * A.alpha;
    return (struct wrench){moment - link->sine * s->turn.y - link->cosine * s->turn.x,
                           vec_sub(f, link->force)};
}

static double power_of(struct wrench p, struct acceleration A)
{
    return p.moment * A.alpha + vec_dot(p.force, A.a);
}

/* M s = f of the independent coordinates: s overwrites f. */
static void solve(double M[most_independent][most_independent], double *f, int count)
{
    for (int k = 0; k < count; k++)
        for (int i = k + 1; i < count; i++) {
            double share = M[i][k] / M[k][k];
            for (int j = k; j < count; j++) M[i][j] -= share * M[k][j];
            f[i] -= share * f[k];
        }
    for (int k = count; k-- > 0;) {
        for (int j = k + 1; j < count; j++) f[k] -= M[k][j] * f[j];
        f[k] /= M[k][k];
    }
}

/* Add the accelerations along the null space. */
static void add_free_motion(const struct closed_loops *loops, const struct instant *at, const double *slots)
{
    const struct tree *tree = loops->tree;
    struct tree_state *links = at->tree->links;
    struct tree_rhs *x = at->tree->x;
    double M[most_independent][most_independent] = {{0}}, f[most_independent] = {0};
    int count = loops->independent_count;
    for (int i = 1; i < tree->joined; i++) {
        links[i].mr = vec_turn(links[i].turn, tree->links[i].moment);
        x[i].p = lacking(&tree->links[i], &links[i], loops->A[i]);
    }
    for (int k = 0; k < count; k++) accelerate_links(loops, links, loops->basis[k], loops->B[k]);
    tree_load(tree, at, &tree->joined_loads);
    for (int i = 1; i < tree->joined; i++) {
        const struct tree_link *link = &tree->links[i];
        struct inertia_about_O I = {link->I_O, vec_perp(links[i].mr), link->mass, 0, link->mass};
        for (int k = 0; k < count; k++) {
            struct wrench inertia = inertia_wrench(&I, loops->B[k][i], (struct wrench){0, {0, 0}});
            for (int l = 0; l <= k; l++) M[k][l] += power_of(inertia, loops->B[l][i]);
            f[k] += loops->basis[k][i] * slots[link->coordinate] - power_of(x[i].p, loops->B[k][i]);
        }
    }
    for (int k = 0; k < count; k++)
        for (int l = 0; l < k; l++) M[l][k] = M[k][l];
    solve(M, f, count);
    for (int i = 1; i < tree->joined; i++)
        for (int k = 0; k < count; k++) loops->a[i] += f[k] * loops->basis[k][i];
}

static void read_joints(const struct closed_loops *loops, const double *y, int n)
{
    for (int i = 1; i < loops->tree->joined; i++) {
        loops->q[i] = y[loops->tree->links[i].coordinate];
        loops->v[i] = y[n + loops->tree->links[i].coordinate];
    }
}

bool closed_loops_rates(struct closed_loops *loops, const struct instant *at, int n, const double *slots,
                        double *dydt)
{
    struct tree_state *links = at->tree->links;
    if (loops->unfit || loops->suspended) return false;
    read_joints(loops, at->y, n);
    if (!close_gaps(loops, links, within)) return false;
    close_rates(loops, within);
    set_basis(loops);
    move_links(loops, links);
    bool even = set_particular(loops, links);
    if (loops->share >= well && !loops->held) loops->even = even;
    if (!is_regular(loops)) return false;
    add_free_motion(loops, at, slots);
    for (int i = 1; i < loops->tree->joined; i++) {
        dydt[loops->tree->links[i].coordinate] = loops->v[i];
        dydt[n + loops->tree->links[i].coordinate] = loops->a[i];
    }
    return true;
}

bool closed_loops_close(struct closed_loops *loops, struct tree_work *work, int n, double *y)
{
    if (loops->unfit || loops->suspended) return false;
    read_joints(loops, y, n);
    if (!close_gaps(loops, work->links, at_ends)) return false;
    close_rates(loops, at_ends);
    for (int i = 1; i < loops->tree->joined; i++) {
        y[loops->tree->links[i].coordinate] = loops->q[i];
        y[n + loops->tree->links[i].coordinate] = loops->v[i];
    }
    return true;
}
