// The cost of kernels: the counts of bytes, operations and fetches.
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
    return kernelCosts(scene, plan, {Path::fused, "", lanes}, {})[0];
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
    const KernelCost gusts = costOfBench(one, bench::cloth(2));
    CHECK(gusts.operations > 2 * quad.operations);
    CHECK(gusts.operations < 5 * quad.operations);
    const double readings = 4 * 4;
    CHECK(gusts.tableFetches == readings * 3);  // a gust 1, curl noise 2
    one.sampling = FieldSampling::moleculeFrame;
    CHECK(costOfBench(one, bench::cloth(2)).operations < 2 * quad.operations);
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
    CHECK(costOf(ColliderShape{DistanceFieldCollider{}}).fetches > 0);
    CHECK(costOf(ColliderShape{PlaneCollider{}}).fetches == 0);
}

TEST_CASE("noise by table costs the same for any octaves, computed noise what its octaves cost", "[cost]") {
    CurlNoiseField noise;
    const auto cost = [&](NoiseForm form, int octaves) {
        noise.noise = form;
        noise.octaves = octaves;
        return costOf(FieldShape{noise});
    };
    const ReadingCost table = cost(NoiseForm::table, 1), computed = cost(NoiseForm::computed, 1);
    CHECK(cost(NoiseForm::table, 3).operations == table.operations);
    CHECK(table.fetches == 2);
    CHECK(computed.fetches == 0);
    CHECK(computed.operations > 20 * table.operations);
    CHECK(cost(NoiseForm::computed, 3).operations == Approx(3 * computed.operations));
    GustField gust;
    CHECK(costOf(FieldShape{gust}).fetches == 1);
    const double gustByTable = costOf(FieldShape{gust}).operations;
    gust.noise = NoiseForm::computed;
    CHECK(costOf(FieldShape{gust}).fetches == 0);
    CHECK(costOf(FieldShape{gust}).operations > 10 * gustByTable);
}
