#include "TrimLineFile.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <limits>
#include <sstream>
#include <system_error>

namespace nurbs
{
namespace
{
/// The characters that part the values of a line: each of them, or as many as stand together.
struct Separators
{
  std::string Characters;
  bool KeepsEmpty;
};
const Separators Semicolons{ ";", true };
const Separators Commas{ ",", true };
const Separators Blanks{ " \t", false };
const Separators SemicolonsOrBlanks{ "; \t", false };
const Separators CommasOrBlanks{ ", \t", false };
const Separators Any{ ",; \t", false };

std::string WithoutBlanksAround(const std::string& text)
{
  const size_t first = text.find_first_not_of(Blanks.Characters);
  const size_t last = text.find_last_not_of(Blanks.Characters);
  return first == std::string::npos ? std::string() : text.substr(first, last + 1 - first);
}

/// The values of a line, without the quotes that some programs put round them.
std::vector<std::string> SplitLine(const std::string& line, const Separators& separators)
{
  std::vector<std::string> values(1);
  bool quoted = false;
  for (const char c : line)
  {
    const bool separates = !quoted && separators.Characters.find(c) != std::string::npos;
    quoted = quoted != (c == '"');
    if (separates)
    {
      values.emplace_back();
    }
    else if (c != '"')
    {
      values.back() += c;
    }
  }
  std::transform(values.begin(), values.end(), values.begin(), WithoutBlanksAround);
  if (!separators.KeepsEmpty)
  {
    values.erase(std::remove(values.begin(), values.end(), std::string()), values.end());
  }
  return values;
}

/// Names of columns may have blanks in them, and in an export in German or French commas.
const Separators& SeparatorsOfHeader(const std::string& line)
{
  return line.find(';') != std::string::npos ? Semicolons
    : line.find(',') != std::string::npos    ? Commas
                                             : Blanks;
}

/// In which columns of a file the coordinates are, and how many columns it has.
struct Layout
{
  std::array<size_t, 3> Columns{ 0, 1, 2 };
  size_t Width = 3;
};

/// The names in a header without units, as in "x [mm]" and "x(mm)".
std::vector<std::string> NamesIn(const std::string& header)
{
  const Separators& separators = SeparatorsOfHeader(header);
  std::vector<std::string> names;
  for (const std::string& text : SplitLine(header, separators))
  {
    const std::string name = WithoutBlanksAround(text.substr(0, text.find_first_of("[(")));
    if (separators.KeepsEmpty || !name.empty()) // a unit may stand by itself
    {
      names.push_back(name);
    }
  }
  return names;
}

/// The column of a name, as many as there are if there is none.
size_t ColumnOf(const std::vector<std::string>& names, const std::string& name)
{
  return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Names that differ in a letter x, y or z only, as in "X_coord" and "Y_coord", begin at a column.
bool FindAxes(const std::vector<std::string>& names, size_t column, Layout& layout)
{
  const std::string& name = names[column];
  for (size_t at = name.find('x'); at != std::string::npos; at = name.find('x', at + 1))
  {
    std::string y = name, z = name;
    y[at] = 'y';
    z[at] = 'z';
    layout.Columns = { column, ColumnOf(names, y), ColumnOf(names, z) };
    layout.Width = names.size();
    if (std::max(layout.Columns[1], layout.Columns[2]) < names.size())
    {
      return true;
    }
  }
  return false;
}

/// As the names in a header say, those of ParaView's spreadsheet among them; three columns if they
/// say nothing, or several things.
Layout FindLayout(const std::string& header)
{
  std::vector<std::string> names = NamesIn(header);
  std::transform(names.begin(), names.end(), names.begin(),
    [](const std::string& name) { return vtksys::SystemTools::LowerCase(name); });
  for (const auto& wanted : { std::array<const char*, 3>{ "x", "y", "z" },
         std::array<const char*, 3>{ "points:0", "points:1", "points:2" } })
  {
    Layout layout;
    std::transform(wanted.begin(), wanted.end(), layout.Columns.begin(),
      [&](const char* name) { return ColumnOf(names, name); });
    layout.Width = names.size();
    if (*std::max_element(layout.Columns.begin(), layout.Columns.end()) < names.size())
    {
      return layout;
    }
  }
  std::vector<Layout> found(1);
  for (size_t column = 0; column < names.size(); ++column)
  {
    Layout layout;
    if (FindAxes(names, column, layout))
    {
      found.push_back(layout);
    }
  }
  return found.size() == 2 ? found[1] : Layout();
}

/// The mark that spreadsheets put before UTF-8.
void SkipByteOrderMark(std::istream& stream)
{
  for (const char expected : { '\xEF', '\xBB', '\xBF' })
  {
    if (stream.peek() != std::istream::traits_type::to_int_type(expected))
    {
      return;
    }
    stream.get();
  }
}

/// Some spreadsheets save so; no UTF-8 starts like that.
bool IsUTF16(std::istream& stream)
{
  const int first = stream.peek();
  return first == 0xFF || first == 0xFE;
}

/// The rest of a file with line ends of one kind: some spreadsheets end lines with a carriage
/// return alone. Old programs end a text with the control character Z.
std::istringstream TakeLines(std::istream& stream)
{
  std::string text;
  constexpr char endOfText = '\x1A';
  for (char c; stream.get(c) && c != endOfText;)
  {
    const bool ofTwo = c == '\r' && stream.peek() == '\n';
    if (!ofTwo)
    {
      text += c == '\r' ? '\n' : c;
    }
  }
  return std::istringstream(text);
}

/// The beginning of a line, for a message: control characters would end or tear it.
std::string Quote(const std::string& line)
{
  std::string text = line.substr(0, 60);
  std::replace_if(
    text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, '?');
  return '"' + text + '"';
}

/// Not strtod: a decimal point whatever the locale.
bool ReadNumber(const std::string& text, double& number)
{
  const size_t sign = text.size() > 1 && text[0] == '+' ? 1 : 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data() + sign, end, number);
  return result.ec == std::errc() && result.ptr == end;
}

/// @param decimal the character between the whole of a number and its fraction.
bool TakePoint(std::vector<std::string> values, const Layout& layout, char decimal, Vec3& point)
{
  bool complete = values.size() == layout.Width;
  for (size_t axis = 0; axis < 3 && complete; ++axis)
  {
    std::string& value = values[layout.Columns[axis]];
    std::replace(value.begin(), value.end(), decimal, '.');
    complete = ReadNumber(value, point[axis]);
  }
  return complete && point.allFinite();
}

/// A way to read the lines of a file.
struct Reading
{
  const Separators& Between;
  char Decimal;
};
/// A comma parts values where that makes as many as there are columns, and else is a decimal one.
/// No two of them make different points of a file, as the number of columns is given.
const std::array<Reading, 4> Readings{ { { Commas, '.' }, { CommasOrBlanks, '.' },
  { Semicolons, ',' }, { SemicolonsOrBlanks, ',' } } };

/// The points of a file in all the ways in which every line of it can be read.
class Points
{
public:
  /// False if there is no such way any more.
  bool Add(const std::string& line, const Layout& layout)
  {
    const auto commas = static_cast<size_t>(std::count(line.begin(), line.end(), ','));
    // Some values parted by commas and others by blanks are fewer values with decimal commas.
    const bool mixed = commas > 0 && commas + 1 < layout.Width;
    bool fits = false;
    for (size_t k = 0; k < Readings.size(); ++k)
    {
      const Reading& reading = Readings[k];
      Vec3 point;
      this->Fits[k] = this->Fits[k] && !(mixed && &reading.Between == &CommasOrBlanks) &&
        TakePoint(SplitLine(line, reading.Between), layout, reading.Decimal, point);
      if (this->Fits[k])
      {
        this->Read[k].push_back(point);
        fits = true;
      }
    }
    return fits;
  }

  bool IsEmpty() const
  {
    return std::all_of(
      this->Read.begin(), this->Read.end(), [](const auto& points) { return points.empty(); });
  }

  /// By the first way; none if nothing was added.
  std::vector<Vec3> Take()
  {
    const auto first = std::find(this->Fits.begin(), this->Fits.end(), true);
    return std::move(this->Read[static_cast<size_t>(first - this->Fits.begin())]);
  }

private:
  std::array<bool, Readings.size()> Fits{ true, true, true, true };
  std::array<std::vector<Vec3>, Readings.size()> Read;
};

bool HasNumber(const std::vector<std::string>& values)
{
  double number;
  return std::any_of(values.begin(), values.end(),
    [&number](const std::string& value) { return ReadNumber(value, number); });
}

/// Tells lists of points that blank lines part from one list with blank lines here and there, or
/// after each point, as some programs write them.
class Paragraphs
{
public:
  void AddPoint() { ++this->Own; }
  void End(size_t number)
  {
    if (this->Own > 0)
    {
      this->First = this->Count == 0 ? number : this->First;
      this->Shortest = std::min(this->Shortest, this->Own);
      ++this->Count;
      this->Own = 0;
    }
  }
  /// After the last point.
  bool AreLines()
  {
    this->End(0);
    return this->Count > 1 && this->Shortest >= 3;
  }
  /// The number of the first blank line behind a point.
  size_t FirstEnd() const { return this->First; }

private:
  size_t Own = 0, Count = 0, First = 0;
  size_t Shortest = std::numeric_limits<size_t>::max(); ///< points of a list
};

/// The lines of a file.
/// @param file how it is called in an error.
bool OpenFile(
  const std::string& path, const std::string& file, std::istringstream& lines, std::string& error)
{
  const std::string advice = "; give the path of an existing CSV, IGES or STEP file";
  std::error_code unread;
  // Before it is opened: to open a pipe means to wait until somebody writes.
  if (std::filesystem::is_other(path, unread))
  {
    error = file + " is no ordinary file" + advice;
    return false;
  }
  vtksys::ifstream stream(path.c_str());
  if (!stream || vtksys::SystemTools::FileIsDirectory(path))
  {
    error = file + " cannot be read" + advice;
    return false;
  }
  if (IsUTF16(stream))
  {
    error = file + " is in UTF-16; save it as CSV in UTF-8";
    return false;
  }
  SkipByteOrderMark(stream);
  lines = TakeLines(stream);
  return true;
}
}

//------------------------------------------------------------------------------
bool ReadTrimLineFile(const std::string& path, std::vector<Vec3>& points, std::string& error)
{
  points.clear();
  const std::string file = "The file of points \"" + path + "\"";
  std::istringstream lines;
  if (!OpenFile(path, file, lines, error))
  {
    return false;
  }
  std::string line;
  Layout layout;
  Points read;
  bool headerMayCome = true;
  Paragraphs paragraphs;
  for (size_t number = 1; std::getline(lines, line); ++number)
  {
    const std::vector<std::string> values = SplitLine(line, Any);
    if (values.empty())
    {
      paragraphs.End(number);
      continue;
    }
    if (!values[0].empty() && values[0][0] == '#')
    {
      continue;
    }
    const bool header = headerMayCome && !HasNumber(values);
    headerMayCome = false;
    if (header)
    {
      layout = FindLayout(line);
      continue;
    }
    if (!read.Add(line, layout))
    {
      error = file + ", line " + std::to_string(number) + " is " + Quote(line) +
        "; expected three finite numbers x, y, z, " +
        (read.IsEmpty() ? "" : "parted as in the lines before, ") +
        "or a header that says which columns they are in";
      return false;
    }
    paragraphs.AddPoint();
  }
  points = read.Take();
  if (points.empty())
  {
    error = file + " holds no points; give a file with three numbers x, y, z a line";
    return false;
  }
  if (paragraphs.AreLines())
  {
    error = file + " has several lists of points, parted by blank lines as line " +
      std::to_string(paragraphs.FirstEnd()) +
      " is; a file holds one trim line: put each into a file of its own";
    return false;
  }
  return true;
}
}
