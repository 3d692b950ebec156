#include "app/export/export.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>
#include <sstream>

#include "core/file.h"
#include "core/printable.h"

namespace shoal::app {

namespace {

// The arrays that are written, in the order of the file.
struct Tables {
    std::vector<double> points;
    std::vector<float> velocities, normals;
    std::vector<int32_t> groups, molecules, vertices;
    // of each kind of cell the points, and where each cell's end
    struct Cells {
        std::vector<int32_t> points, ends;
        void add(std::initializer_list<size_t> corners) {
            for (const size_t corner : corners)
                points.push_back(int32_t(corner));
            ends.push_back(int32_t(points.size()));
        }
    } verts, lines, polys;
};

template <typename T>
void push(std::vector<T>& out, const auto& v) {
    out.insert(out.end(), {T(v.x), T(v.y), T(v.z)});
}

void addCells(Tables& out, const Molecule& molecule, size_t first, size_t vertexCount, ExportCells cells) {
    if (cells == ExportCells::surface && !molecule.triangles.empty())
        for (const Triangle& t : molecule.triangles)
            out.polys.add({first + size_t(t.a), first + size_t(t.b), first + size_t(t.c)});
    else if (cells == ExportCells::springs && !molecule.springs.empty())
        for (const Spring& s : molecule.springs)
            out.lines.add({first + size_t(s.a), first + size_t(s.b)});
    else
        for (size_t v = 0; v < vertexCount; ++v)
            out.verts.add({first + v});
}

Tables tablesOf(Simulation& simulation, const Scene& scene, ExportCells cells) {
    Tables out;
    forMolecules(simulation, [&](size_t g, const Snapshot& state, size_t m) {
        const size_t perMolecule = size_t(state.vertexCount);
        addCells(out, scene.groups[g].molecule, out.groups.size(), perMolecule, cells);
        for (size_t v = 0; v < perMolecule; ++v) {
            const size_t i = m * perMolecule + v;
            push(out.points, state.positions[i]);
            push(out.velocities, state.velocities[i]);
            push(out.normals, state.normals[i]);
            out.groups.push_back(int32_t(g));
            out.molecules.push_back(int32_t(m));
            out.vertices.push_back(int32_t(v));
        }
    });
    return out;
}

// The XML in front and the data behind: arrays in the order in which they are named.
class VtpText {
  public:
    std::ostringstream xml;

    template <typename T>
    void array(const char* name, int components, const std::vector<T>& values, const char* units = nullptr,
               bool ofTheWhole = false) {
        const char* type = std::is_same_v<T, float>    ? "Float32"
                           : std::is_same_v<T, double> ? "Float64"
                                                       : "Int32";
        xml << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
            << components << "\" format=\"appended\" offset=\"" << offset_ << "\"";
        if (ofTheWhole) xml << " NumberOfTuples=\"" << values.size() / size_t(components) << "\"";
        if (units)
            xml << "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">" << units
                << "</InformationKey></DataArray>\n";
        else
            xml << "/>\n";
        data_.push_back(std::as_bytes(std::span(values)));
        offset_ += sizeof(uint64_t) + values.size() * sizeof(T);
    }

    void cells(const char* tag, const Tables::Cells& cells) {
        xml << "<" << tag << ">\n";
        array("connectivity", 1, cells.points);
        array("offsets", 1, cells.ends);
        xml << "</" << tag << ">\n";
    }

    void write(const std::string& file) {
        FileWriter out(file);
        const std::string head = xml.str(), tail = "\n</AppendedData>\n</VTKFile>\n";
        out.write(head.data(), head.size());
        for (const std::span<const std::byte> bytes : data_) {
            const uint64_t size = bytes.size();
            out.write(&size, sizeof size);
            out.write(bytes.data(), bytes.size());
        }
        out.write(tail.data(), tail.size());
        out.finish();
    }

  private:
    std::vector<std::span<const std::byte>> data_;
    size_t offset_ = 0;
};

const char* byteOrder() {
    return std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
}

}  // namespace

void writeVtp(const std::string& file, Simulation& simulation, const Scene& scene, ExportCells cells) {
    const Tables tables = tablesOf(simulation, scene, cells);
    const std::vector<double> time = {simulation.time()};
    const std::vector<int32_t> frame = {simulation.frames()};
    VtpText text;
    text.xml << "<?xml version=\"1.0\"?>\n<!-- shoal: metres, seconds -->\n<VTKFile type=\"PolyData\" "
                "version=\"1.0\" byte_order=\""
             << byteOrder() << "\" header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
    text.array("TimeValue", 1, time, "s", true);
    text.array("frame", 1, frame, nullptr, true);
    text.xml << "</FieldData>\n<Piece NumberOfPoints=\"" << tables.groups.size() << "\" NumberOfVerts=\""
             << tables.verts.ends.size() << "\" NumberOfLines=\"" << tables.lines.ends.size()
             << "\" NumberOfStrips=\"0\" NumberOfPolys=\"" << tables.polys.ends.size() << "\">\n<Points>\n";
    const bool far = std::any_of(tables.points.begin(), tables.points.end(),
                                 [](double x) { return std::abs(x) >= farOff; });
    std::vector<float> points;
    if (!far) points.assign(tables.points.begin(), tables.points.end());
    if (far)
        text.array("Points", 3, tables.points, "m");
    else
        text.array("Points", 3, points, "m");
    text.xml << "</Points>\n<PointData Vectors=\"velocity\" Normals=\"normal\">\n";
    text.array("velocity", 3, tables.velocities, "m/s");
    text.array("normal", 3, tables.normals);
    text.array("group", 1, tables.groups);
    text.array("molecule", 1, tables.molecules);
    text.array("vertex", 1, tables.vertices);
    text.xml << "</PointData>\n";
    text.cells("Verts", tables.verts);
    text.cells("Lines", tables.lines);
    text.cells("Polys", tables.polys);
    text.xml << "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    text.write(file);
}

// A value between double quotes. Error: XML has no way to write it.
static std::string xmlQuoted(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const Utf8 character = firstCharacter(text);
        const bool known = character.code == '\n' || character.code == '\r' || character.code == '\t' ||
                           (character.code >= 0x20 && character.code < 0xfffe) ||
                           (character.code >= 0x10000 && character.code <= 0x10ffff);
        if (!known)
            throw Error(concat("\"", text,
                               "\": an index (.pvd) cannot name a file with control characters or "
                               "bytes that are no UTF-8"));
        if (character.code < 0x20 || std::string_view("\"&<>").find(text[0]) != std::string_view::npos)
            out += concat("&#", character.code, ";");
        else
            out += text.substr(0, character.bytes);
        text.remove_prefix(character.bytes);
    }
    return out;
}

PvdIndex::PvdIndex(std::string file, double until) : file_(std::move(file)) {
    std::error_code code;
    if (!std::filesystem::is_regular_file(file_, code)) return;
    std::istringstream old(readFile(file_));
    for (std::string line; std::getline(old, line);) {
        double time = 0;
        if (std::sscanf(line.c_str(), "<DataSet timestep=\"%lf\"", &time) == 1 &&
            time < until * (1 - 1e-8) &&  // it was written with nine digits
            line.ends_with("\"/>") && line.find('<', 1) == std::string::npos)  // a line of ours
            lines_ += line + "\n";
    }
}

void PvdIndex::add(double time, const std::string& dataFile) {
    lines_ += concat("<DataSet timestep=\"", formatted("%.9g", time), "\" part=\"0\" file=\"",
                     xmlQuoted(dataFile), "\"/>\n");
    writeFile(file_,
              std::string_view(concat(
                  "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"",
                  byteOrder(), "\">\n<Collection>\n", lines_, "</Collection>\n</VTKFile>\n")));
}

}  // namespace shoal::app
