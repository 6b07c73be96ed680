/**
 * @file CADFile.h
 * @brief Reads the faces of an IGES or STEP file as NURBS surfaces.
 *
 * A plain function of plain data: neither VTK nor OpenCASCADE shows, so that it can as well run
 * in a process of its own.
 */
#ifndef CADFile_h
#define CADFile_h

#include "NurbsSurface.h"

#include <functional>
#include <string>
#include <vector>

namespace nurbs
{
/// One face of a file.
struct NamedSurface
{
  /// The file's name for the face; else its nearest named owner's with the number of the face
  /// in it; else "Face 3", counted over the whole file.
  std::string Name;
  NurbsSurface Surface;
};

/// Called now and then with the share done, 0..1; false asks to stop.
using ReadProgress = std::function<bool(double)>;

/// Appends to the one line that there is to say of a file, which names it first.
inline void AddRemark(const std::string& path, const std::string& text, std::string& remarks)
{
  remarks += (remarks.empty() ? "CAD file \"" + path + "\": " : "; ") + text;
}

/// Shares between which bodies are joined.
constexpr double JoiningBegins = 0.5;
constexpr double JoiningEnds = 0.7;

/**
 * Reads every face of the file, its format told by its content, whatever it is called.
 *
 * Each surface is restricted to the face's parameter range and oriented so that S_u x S_v is
 * the face's own normal (outward for a solid). Analytic surfaces are converted exactly; only
 * offset surfaces without an analytic form are approximated, to 1e-7 of their size, at worst to
 * 1e-6; those that cannot be are left out.
 * TrimLoops are present where the face is less than its parameter rectangle; their chords
 * deviate by at most 1e-6 of the face's size.
 *
 * @param path             the file.
 * @param unitInMillimetres length of the output's unit: 25.4 for inches. The file's own unit is
 *                         honoured.
 * @param joinBodies       whether bodies that touch or cross each other are joined (CADBodies.h).
 * @param surfaces         at least one valid surface if true is returned, else empty.
 * @param error            one line that names the file, what is wrong and what to do; with
 *                         true, empty, or one line on faces that had to be left out.
 * @return false on any error; also when stopped by `progress`, then with an empty `error`.
 */
bool ReadCADFile(const std::string& path, double unitInMillimetres, bool joinBodies,
  std::vector<NamedSurface>& surfaces, std::string& error,
  const ReadProgress& progress = ReadProgress());
}

#endif
