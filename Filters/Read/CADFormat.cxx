#include "CADFormat.h"

#include "vtksys/SystemTools.hxx"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include <sys/stat.h>

namespace nurbs
{
namespace
{
/// Column 73 of an IGES line holds the letter of its section.
constexpr size_t SectionColumn = 72;

/// Reads a line that ends with LF or CR LF; false at the end of the file. The length is limited
/// so that a binary file without line ends is not swallowed whole.
bool ReadLine(std::istream& stream, std::string& line)
{
  line.clear();
  char c = 0;
  while (line.size() < 4096 && stream.get(c) && c != '\n')
  {
    line.push_back(c);
  }
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  return !line.empty() || static_cast<bool>(stream);
}

/// The number in columns 74 to 80 of an IGES line, or -1.
long SequenceNumber(const std::string& line)
{
  const std::string digits = line.substr(SectionColumn + 1, 7);
  char* end = nullptr;
  const long number = std::strtol(digits.c_str(), &end, 10);
  while (*end == ' ')
  {
    ++end;
  }
  return end == digits.c_str() || *end != '\0' ? -1 : number;
}

/// The section letter of a line that is made like a line of IGES, else 0.
char IgesSection(const std::string& line)
{
  if (line.size() <= SectionColumn || SequenceNumber(line) < 0)
  {
    return 0;
  }
  const char letter = line[SectionColumn];
  return std::strchr("SGDPTCB", letter) ? letter : 0;
}

/// The first line that is not blank begins with ISO-10303-21, perhaps after comments.
bool BeginsLikeStep(std::istream& stream)
{
  std::string head(65536, '\0');
  stream.read(&head[0], static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(stream.gcount()));
  size_t at = head.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;
  while (at < head.size())
  {
    if (std::isspace(static_cast<unsigned char>(head[at])))
    {
      ++at;
    }
    else if (head.compare(at, 2, "/*") == 0)
    {
      at = head.find("*/", at);
      at = at == std::string::npos ? head.size() : at + 2;
    }
    else
    {
      return head.compare(at, 12, "ISO-10303-21") == 0;
    }
  }
  return false;
}

/// How many lines of the sections S, G, D and P the terminate line promises; -1: not said.
std::array<long, 4> PromisedLines(const std::string& line)
{
  std::array<long, 4> counts{ -1, -1, -1, -1 };
  const char letters[] = "SGDP";
  for (int i = 0; i < 4; ++i)
  {
    const std::string field = line.substr(8 * i, 8);
    if (!field.empty() && field[0] == letters[i])
    {
      counts[i] = std::strtol(field.c_str() + 1, nullptr, 10);
    }
  }
  return counts;
}

/// What FindIgesLoss says of a file of another form, of which the lines cannot be counted.
constexpr const char* CompressedIges = "compressed";

/// What an IGES file lacks; empty: nothing.
std::string FindIgesLoss(std::istream& stream)
{
  std::array<long, 4> found{ 0, 0, 0, 0 };
  std::string line;
  std::ostringstream loss;
  while (ReadLine(stream, line))
  {
    const char section = IgesSection(line);
    if (section == 'T')
    {
      const std::array<long, 4> promised = PromisedLines(line);
      // Not the start section, which is for the eye: some programs count it wrongly.
      for (int i = 1; i < 4; ++i)
      {
        if (found[i] < promised[i])
        {
          loss << "section "
               << "SGDP"[i] << " has " << found[i] << " lines of " << promised[i];
          return loss.str();
        }
      }
      return std::string();
    }
    if (section == 'C' || section == 'B')
    {
      return CompressedIges;
    }
    const char* letters = "SGDP";
    if (const char* at = section ? std::strchr(letters, section) : nullptr)
    {
      ++found[at - letters];
    }
  }
  loss << "the terminate section is missing after " << found[2] << " directory and " << found[3]
       << " parameter lines";
  return loss.str();
}

/// True if the end mark of STEP stands near the end of the file: what follows it, as a signature,
/// is no loss.
bool EndsLikeStep(std::istream& stream)
{
  stream.clear();
  stream.seekg(0, std::ios::end);
  const std::streamoff size = stream.tellg();
  const std::streamoff length = std::min<std::streamoff>(size, 65536);
  stream.seekg(size - length);
  std::string tail(static_cast<size_t>(length), '\0');
  stream.read(&tail[0], length);
  return tail.find("END-ISO-10303-21") != std::string::npos;
}

bool IsOrdinaryFile(const std::string& path)
{
  struct stat status;
  return stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}
}

//------------------------------------------------------------------------------
CADFormat RecognizeCADFile(const std::string& path)
{
  // Before it is opened: to open a pipe means to wait until somebody writes.
  if (!IsOrdinaryFile(path))
  {
    return CADFormat::None;
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
  {
    return CADFormat::None;
  }
  std::string line;
  if (ReadLine(stream, line) && IgesSection(line))
  {
    return CADFormat::IGES;
  }
  stream.clear();
  stream.seekg(0);
  return BeginsLikeStep(stream) ? CADFormat::STEP : CADFormat::None;
}

//------------------------------------------------------------------------------
bool IsCalledCADFile(const std::string& path)
{
  using Tools = vtksys::SystemTools;
  const std::string extension = Tools::LowerCase(Tools::GetFilenameLastExtension(path));
  const std::array<const char*, 4> known{ ".igs", ".iges", ".stp", ".step" }; // as in Read.xml
  return std::find(known.begin(), known.end(), extension) != known.end() && IsOrdinaryFile(path);
}

//------------------------------------------------------------------------------
CADFormat CheckCADFile(const std::string& path, std::string& error)
{
  const std::string file = "CAD file \"" + path + "\"";
  struct stat status;
  error.clear();
  if (path.empty())
  {
    error = "no CAD file is named; set FileName to an IGES or STEP file";
  }
  else if (stat(path.c_str(), &status) != 0)
  {
    error = file + " cannot be found (" + std::strerror(errno) + "); check FileName";
  }
  else if (S_ISDIR(status.st_mode))
  {
    error = file + " is a directory; name an IGES or STEP file in it";
  }
  else if (!S_ISREG(status.st_mode))
  {
    error = file + " is no ordinary file; name an IGES or STEP file";
  }
  else if (status.st_size == 0)
  {
    error = file + " is empty; export it again from the CAD program";
  }
  else if (!std::ifstream(path))
  {
    error = file + " cannot be opened; check its permissions";
  }
  if (!error.empty())
  {
    return CADFormat::None;
  }

  const CADFormat format = RecognizeCADFile(path);
  std::ifstream stream(path, std::ios::binary);
  if (format == CADFormat::None)
  {
    error = file + " is neither IGES nor STEP by its content; export the surfaces as one of them";
  }
  else if (format == CADFormat::STEP && !EndsLikeStep(stream))
  {
    error = file + " is cut short: END-ISO-10303-21 is missing at its end; copy or export it again";
  }
  else if (format == CADFormat::IGES)
  {
    const std::string loss = FindIgesLoss(stream);
    if (loss == CompressedIges)
    {
      error = file + " is compressed or binary IGES; export it as plain (fixed format) IGES";
    }
    else if (!loss.empty())
    {
      error = file + " is cut short: " + loss + "; copy or export it again";
    }
  }
  return error.empty() ? format : CADFormat::None;
}
}
