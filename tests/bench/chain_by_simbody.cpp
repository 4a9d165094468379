// SPDX-License-Identifier: GPL-3.0-or-later
//
// The chain in Simbody: pins about z, y up.
#include <Simbody.h>

#include "chain.h"

namespace {

struct Chain {
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter;
    SimTK::GeneralForceSubsystem forces;
    SimTK::State state;

    explicit Chain(int n) : matter(system), forces(system)
    {
        using namespace SimTK;
        const Real m = CHAIN_MASS, l = CHAIN_LENGTH;
        forces.setNumberOfThreads(1); // handing gravity over to other threads takes longer than the chain
        const Vec3 center(0, -l / 2, 0), end(0, -l, 0);
        Force::Gravity gravity(forces, matter, Vec3(0, -CHAIN_GRAVITY, 0));
        Body::Rigid rod(MassProperties(m, center, Inertia(m * l * l / 3, 0, m * l * l / 3)));
        MobilizedBody parent = matter.Ground();
        for (int i = 0; i < n; i++) {
            MobilizedBody::Pin next(parent, Transform(i == 0 ? Vec3(0) : end), rod, Transform());
            parent = next;
        }
        state = system.realizeTopology();
        system.realizeModel(state);
    }
};

void *open(int n)
{
    try {
        return new Chain(n);
    } catch (const std::exception &) {
        return nullptr;
    }
}

void rates(void *data, const double *y, double *dydt)
{
    Chain *chain = static_cast<Chain *>(data);
    SimTK::Vector &Q = chain->state.updQ(), &U = chain->state.updU();
    int n = Q.size();
    for (int i = 0; i < n; i++) {
        Q[i] = y[i];
        U[i] = y[n + i];
    }
    chain->system.realize(chain->state, SimTK::Stage::Acceleration);
    const SimTK::Vector &accelerations = chain->state.getUDot();
    for (int i = 0; i < n; i++) {
        dydt[i] = y[n + i];
        dydt[n + i] = accelerations[i];
    }
}

void close(void *data)
{
    delete static_cast<Chain *>(data);
}

} // namespace

extern "C" const chain_solver chain_by_simbody = {"Simbody", open, rates, close};
