/**
 * @file CADFormat.h
 * @brief Tells IGES from STEP by content, and whole files from ones that were cut short.
 *
 * OpenCASCADE reads a truncated file without complaint, with the faces that are left.
 */
#ifndef CADFormat_h
#define CADFormat_h

#include <string>

namespace nurbs
{
enum class CADFormat
{
  None,
  IGES,
  STEP
};

/// The format by the file's first lines only; None if it is neither or cannot be opened.
CADFormat RecognizeCADFile(const std::string& path);

/// Whether a file is there whose name ends like that of an IGES or STEP file, whatever it holds.
bool IsCalledCADFile(const std::string& path);

/**
 * Looks through the whole file.
 * @return its format; None with one line in `error` if the file is missing, a directory, empty,
 * neither IGES nor STEP, in a form of IGES that is not read (compressed, binary), or cut short.
 */
CADFormat CheckCADFile(const std::string& path, std::string& error);
}

#endif
