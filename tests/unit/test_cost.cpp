// What kernels cost: the counts of bytes, operations and fetches.
#include "bench/case.h"
#include "compile/cost.h"
#include "support/catch.h"
#include "support/every_kind.h"

using namespace shoal;

namespace {

KernelCost costOfBench(bench::BenchCase one, const Molecule& molecule, Lanes lanes = Lanes::automatic) {
    one.count = 3;
    const Scene scene = benchScene(one, molecule);
    const Plan plan = compile(scene);
    return kernelCosts(scene, plan, {Path::fused, ""}, lanes, {})[0];
}

}  // namespace

TEST_CASE("a kernel's bytes and operations are those that its molecule and solver take", "[cost]") {
    bench::BenchCase one;
    const KernelCost quad = costOfBench(one, bench::cloth(2));  // 4 vertices, 6 springs
    CHECK(quad.bytes == 208);
    CHECK(quad.stateFetches == 7);
    CHECK(quad.sharedBytes == 0);
    const double uniformWind = 3;
    CHECK(quad.operations ==
          Approx(4 * (6 * springOperations + 4 * (motionOperations + planeOperations + uniformWind))));

    one.substeps = 8;
    CHECK(costOfBench(one, bench::cloth(2)).operations == Approx(2 * quad.operations));
    one.substeps = 4;
    one.solver = SolverKind::rk4;
    CHECK(costOfBench(one, bench::cloth(2)).operations > 3 * quad.operations);
    one.solver = SolverKind::euler;
    one.wind = bench::Wind::gusts;
    CHECK(costOfBench(one, bench::cloth(2)).operations > 10 * quad.operations);
    one.sampling = FieldSampling::moleculeFrame;
    CHECK(costOfBench(one, bench::cloth(2)).operations < 10 * quad.operations);
}

TEST_CASE("large molecules want more registers than a lane has, or shared memory", "[cost]") {
    bench::BenchCase one;
    const KernelCost quad = costOfBench(one, bench::cloth(2)),
                     cloth = costOfBench(one, bench::cloth(8), Lanes::molecule);
    CHECK_FALSE(quad.spills());
    CHECK(cloth.spills());
    CHECK(cloth.occupancy < quad.occupancy);
    const KernelCost shared = costOfBench(one, bench::cloth(8), Lanes::vertex);
    CHECK(shared.lanes == Lanes::vertex);
    CHECK(shared.sharedBytes == 16 * FusedLimits::sharedBytes(64));  // 16 cloths fit 32 KiB
    CHECK((shared.occupancy > 0 && shared.occupancy <= 1));
}

TEST_CASE("every kind of field and collider has a cost", "[cost]") {
    for (const Field& field : test::everyField())
        CHECK(costOf(*field.shape).operations > 0);
    CurlNoiseField noise;
    const double one = costOf(FieldShape{noise}).operations;
    noise.octaves = 3;
    CHECK(costOf(FieldShape{noise}).operations == Approx(3 * one));
    CHECK(costOf(ColliderShape{DistanceFieldCollider{}}).fetches > 0);
    CHECK(costOf(ColliderShape{PlaneCollider{}}).fetches == 0);
}
