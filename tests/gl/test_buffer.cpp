#include "gpu/buffer.h"

#include <cstdint>
#include <vector>

#include "core/error.h"
#include "gl/gl_test.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal::gpu;
using Kind = Traffic::Kind;

TEST_CASE("a buffer comes back, whole and in part, and is counted", "[buffer]") {
    const std::vector<float> values = {1, 2, 3, 4, 5};
    for (const Buffer::Use use :
         {Buffer::Use::vertex, Buffer::Use::index, Buffer::Use::uniform, Buffer::Use::storage}) {
        INFO("use " << static_cast<int>(use));
        Buffer buffer(testContext(), use, std::span<const float>(values), "five");
        const float patch[] = {30, 40};
        buffer.update(Kind::state, 8, patch, 8);
        const Traffic before = testContext().traffic();
        std::vector<float> all(5), part(2);
        buffer.download(Kind::state, 0, all.data(), 20);
        buffer.download(Kind::control, 12, part.data(), 8);
        CHECK(all == std::vector<float>{1, 2, 30, 40, 5});
        CHECK(part == std::vector<float>{40, 5});
        const Traffic moved = testContext().traffic() - before;
        CHECK(moved.down(Kind::state) == 20);
        CHECK(moved.down(Kind::control) == 8);
        CHECK(moved.up(Kind::state) + moved.total(Kind::parameters) == 0);
    }
    testContext().checkErrors("buffers");
}

TEST_CASE("a buffer is copied without crossing the bus", "[buffer]") {
    const std::vector<float> values = {1, 2, 3, 4}, others = {-1, -2, -3, -4, -5};
    const Buffer from(testContext(), Buffer::Use::storage, std::span<const float>(values), "from");
    Buffer to(testContext(), Buffer::Use::storage, std::span<const float>(others), "to");
    const Traffic before = testContext().traffic();
    from.copyTo(to, 12);
    const Traffic moved = testContext().traffic() - before;
    for (const Kind kind : {Kind::state, Kind::parameters, Kind::control})
        CHECK(moved.total(kind) == 0);
    std::vector<float> all(5);
    to.download(Kind::state, 0, all.data(), 20);
    CHECK(all == std::vector<float>{1, 2, 3, -4, -5});
    testContext().checkErrors("a copy");
}

// Nothing is written into them: a driver that only reserves must not be made to pay.
TEST_CASE("a buffer that does not fit into memory is refused with its size", "[buffer]") {
    for (const size_t bytes :
         {size_t(1) << 50, size_t(1) << 62, (size_t(1) << 63) - 16, size_t(1) << 63, SIZE_MAX}) {
        INFO(bytes << " bytes");
        for (const Buffer::Use use : {Buffer::Use::vertex, Buffer::Use::storage}) {
            CHECK_THAT(messageOf([&] { Buffer(testContext(), use, nullptr, bytes, "giant"); }),
                       Catch::Contains("buffer \"giant\" does not fit into memory: it takes " +
                                       std::to_string(bytes >> 20) + " MiB"));
        }
    }
    CHECK_THROWS_AS(Buffer(testContext(), Buffer::Use::storage, nullptr, size_t(1) << 50, "giant"),
                    OutOfMemory);
    CHECK_NOTHROW(testContext().checkErrors("refused buffers"));
    const float one = 1;  // and the context goes on
    const Buffer buffer(testContext(), Buffer::Use::storage, &one, sizeof one, "one");
    float back = 0;
    buffer.download(Kind::control, 0, &back, sizeof back);
    CHECK(back == 1);
}
