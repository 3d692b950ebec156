// Files that VTK itself wrote, in every encoding it has.
#include <cstdlib>

#include "scene/field_files/field_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;
using Catch::Contains;

namespace {

// Writes w.vti's in the folder of argv[1]; the velocity of point (i, j, k) is (i + 0.5, -j, 8 k + 0.25).
constexpr const char* script = R"(
import sys, vtk
image = vtk.vtkImageData()
image.SetDimensions(7, 5, 9)
image.SetOrigin(1, 2, 3)
image.SetSpacing(0.5, 0.25, 2)
def array(kind, name):
    out = kind()
    out.SetName(name)
    out.SetNumberOfComponents(3)
    for k in range(9):
        for j in range(5):
            for i in range(7):
                out.InsertNextTuple3(i + 0.5, -j, 8 * k + 0.25)
    return out
def write(name, mode, compressor, big, bits, raw):
    writer = vtk.vtkXMLImageDataWriter()
    writer.SetInputData(image)
    writer.SetFileName(sys.argv[1] + '/' + name)
    getattr(writer, 'SetDataModeTo' + mode)()
    getattr(writer, 'SetCompressorTypeTo' + compressor)()
    writer.SetBlockSize(480)
    writer.SetByteOrderToBigEndian() if big else writer.SetByteOrderToLittleEndian()
    writer.SetHeaderType(bits)
    writer.SetEncodeAppendedData(0 if raw else 1)
    assert writer.Write()
number = 0
for kind in (vtk.vtkFloatArray, vtk.vtkDoubleArray):
    image.GetPointData().Initialize()
    image.GetPointData().SetScalars(array(kind, 'other'))
    image.GetPointData().SetVectors(array(kind, 'velocity'))
    for mode, raw in (('Ascii', 0), ('Binary', 0), ('Appended', 0), ('Appended', 1)):
        for compressor in ('None', 'ZLib'):
            for big in (0, 1):
                for bits in (32, 64):
                    write('%d.vti' % number, mode, compressor, big, bits, raw)
                    number += 1
write('lz4.vti', 'Appended', 'LZ4', 0, 32, 1)
print(number)
)";

}  // namespace

TEST_CASE(".vti as VTK writes them", "[fieldFiles][vtk]") {
    if (std::system("/usr/bin/python3 -c 'import vtk' >/dev/null 2>&1") != 0) {
        WARN("skipped: VTK's Python package is not installed (on Debian: apt install python3-vtk9)");
        return;
    }
    const test::Scratch scratch;
    scratch.write("write.py", script);
    REQUIRE(std::system(("/usr/bin/python3 " + scratch.path("write.py") + " " + scratch.folder().string() +
                         " >/dev/null")
                            .c_str()) == 0);
    for (int number = 0; number < 64; ++number) {
        INFO("file " << number);
        const FileGrid grid = readFieldFile(scratch.path(std::to_string(number) + ".vti"), {});
        REQUIRE(grid.resolution == glm::ivec3(7, 5, 9));
        CHECK(grid.low == glm::dvec3(0.75, 1.875, 2));
        size_t at = 0;
        for (int k = 0; k < 9; ++k)
            for (int j = 0; j < 5; ++j)
                for (int i = 0; i < 7; ++i)
                    REQUIRE(grid.values[at++] == glm::vec3(glm::dvec3(i + 0.5, -j, 8 * k + 0.25)));
    }
    CHECK_THAT(messageOf([&] { readFieldFile(scratch.path("lz4.vti"), {}); }),
               Contains("vtkLZ4DataCompressor"));
}
