// The molecule that is being edited (document.cpp), and edits of its draft (edit.cpp, reshape.cpp).
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/json.h"
#include "molecule/draft.h"

namespace shoal {

// A draft, its undo and redo, saving, and a copy of what is not saved that outlives a crash.
class Document {
  public:
    // Error: readMolecule's.
    explicit Document(const std::string& file);
    // Begins a file that saving makes. Error: it cannot be written, or is there.
    Document(const std::string& file, Molecule begin);

    const Draft& draft() const { return now_; }
    const Molecule& molecule() const { return now_.molecule; }
    const std::string& file() const { return file_; }
    // Why it cannot be saved or run as it is; empty: it can.
    const std::string& problem() const { return problem_; }
    int version() const { return version_; }  // another number after every change

    // One step of undo by the name of `label`; calls with the same `gesture` (above 0) that follow one
    // another make one.
    void edit(const std::string& label, const std::function<void(Draft&)>& change, int gesture = 0);
    int newGesture() { return ++gestures_; }
    bool undo() { return step(past_, future_); }
    bool redo() { return step(future_, past_); }
    // The label of the step that undo or redo would take back; empty: there is none.
    std::string undoLabel() const { return past_.empty() ? "" : past_.back().label; }
    std::string redoLabel() const { return future_.empty() ? "" : future_.back().label; }

    bool unsaved() const { return unsaved_; }
    // Into its file's own text. Error: writeFile's, withEdits'; nothing is lost then.
    void save();
    // Takes the file as it is now; one step of undo. Error: readMolecule's; nothing changes then.
    void reload();
    // The file was written by someone else since it was read or saved.
    bool changedOnDisk() const;

    // Whether an earlier editor of the same file left unsaved work that is neither taken nor dropped yet.
    bool recovered() const { return recovered_.has_value(); }
    void takeRecovered();  // one step of undo
    void dropRecovered();
    // Writes what is not saved in the folder where programs keep their state; call now and then.
    // Says once why it cannot.
    std::optional<std::string> keep();
    void closeInOrder();  // nothing is left to be recovered

  private:
    struct Step {
        Draft draft;
        std::string label;  // of what led away from it, in past_; to it, in future_
    };
    bool step(std::vector<Step>& from, std::vector<Step>& to);  // false: there is none
    void changed();
    void findKept();
    void restart(Molecule molecule);
    std::string kept() const;
    std::filesystem::path keptFile() const;

    std::string file_;
    std::string text_;    // of the file, as read or saved last
    bool isNew_ = false;  // there is no file yet
    Draft now_;
    JsonValue saved_;  // what the file says
    std::vector<Step> past_, future_;
    int lastGesture_ = 0, gestures_ = 0, version_ = 0, keptVersion_ = 0;
    bool unsaved_ = false, toldOfKeeping_ = false;
    std::string problem_;
    std::optional<Draft> recovered_;
    std::filesystem::file_time_type written_{};
};

// Edits of a draft, and of its mirror image where symmetry is on. `axis`: the normal of the plane of symmetry
// (0 x, 1 y, 2 z), or -1 for none. Elements that have no mirror image are edited alone.

struct ElementSet {
    std::set<int> vertices, springs, triangles;
    bool empty() const { return vertices.empty() && springs.empty() && triangles.empty(); }
    bool operator==(const ElementSet&) const = default;
};

// m: what is no further from the plane of symmetry lies on it.
double nearPlane(const Molecule& molecule);
// With the images of what is selected.
ElementSet withMirror(const Molecule& molecule, const ElementSet& selected, int axis);

// Moves the vertices by `shift`, and their images by its mirror image; a vertex on the plane stays on it.
// Starts from their positions in `before`, so that one drag does not add up.
void moveVertices(Draft& draft, const Draft& before, const std::set<int>& vertices, const glm::dvec3& shift,
                  int axis);
// The new vertex; its image is there, too, unless it lies on the plane.
int addVertexAt(Draft& draft, const glm::dvec3& position, int axis);
int connect(Draft& draft, int a, int b, int axis);         // the spring; -1: none
int addFace(Draft& draft, int a, int b, int c, int axis);  // the triangle; -1: none
void removeSelected(Draft& draft, const ElementSet& selected, int axis);
void flipTriangles(Draft& draft, const std::set<int>& triangles);

// Adds springs until nothing but motion of the whole is without stiffness (author/springs.h), as stiff as
// most. Says how many; 0: none helps, as in what is flat.
int braceSoftModes(Draft& draft);

// Edits of the whole shape (reshape.cpp). Each tells why it does nothing; else nothing.

// Replaces the side where the axis' coordinate is above 0 by the mirror image of the other.
std::string mirrorSide(Draft& draft, int axis);
// Each of the triangles, or all if there are none, becomes four; springs along their edges become two of
// twice the stiffness, and the mass in all stays. Those beside them are cut so that no gap opens.
std::string subdivide(Draft& draft, const std::set<int>& triangles);
// Masses from a density, kg/m^2, of the triangles' areas; a vertex without any keeps its own.
std::string weigh(Draft& draft, double density);
// kg/m^2, of all mass over all area; 0: there is no area.
double densityOf(const Molecule& molecule);

// Springs whose two ends are selected, or that are selected themselves.
std::set<int> selectedSprings(const Molecule& molecule, const ElementSet& selected);

}  // namespace shoal
