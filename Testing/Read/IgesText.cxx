#include "IgesText.h"

#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace
{
std::string Format(const char* format, ...)
{
  char buffer[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof(buffer), format, arguments);
  va_end(arguments);
  return buffer;
}

/// Breaks a list at commas into lines of at most `width` characters.
std::vector<std::string> Wrap(const std::string& text, size_t width)
{
  std::vector<std::string> lines{ "" };
  size_t at = 0;
  while (at < text.size())
  {
    const size_t comma = text.find(',', at);
    const size_t end = comma == std::string::npos ? text.size() : comma + 1;
    if (lines.back().size() + end - at > width)
    {
      lines.emplace_back();
    }
    lines.back() += text.substr(at, end - at);
    at = end;
  }
  return lines;
}
}

//------------------------------------------------------------------------------
int IgesText::Add(int type, const std::string& parameters, const Entry& entry)
{
  const int number = static_cast<int>(this->Directory.size()) + 1;
  const std::string text = std::to_string(type) + "," + parameters + ";";
  const std::vector<std::string> lines = Wrap(text, 64);
  const int first = static_cast<int>(this->Parameters.size()) + 1;
  this->Directory.push_back(Format("%8d%8d%8d%8d%8d%8d%8d%8d00%02d0000D%7d", type, first, 0, 0, 0,
    0, entry.Transform, 0, entry.Subordinate, number));
  const std::string subscript = entry.Subscript ? Format("%8d", entry.Subscript) : "        ";
  this->Directory.push_back(
    Format("%8d%8d%8d%8d%8d%8s%8s%8s%8sD%7d", type, 0, 0, static_cast<int>(lines.size()),
      entry.Form, "", "", entry.Label.c_str(), subscript.c_str(), number + 1));
  for (const std::string& line : lines)
  {
    const int count = static_cast<int>(this->Parameters.size()) + 1;
    this->Parameters.push_back(Format("%-64s %7dP%7d", line.c_str(), number, count));
  }
  return number;
}

//------------------------------------------------------------------------------
int IgesText::AddOwned(int type, const std::string& parameters, int form)
{
  Entry entry;
  entry.Subordinate = 1;
  entry.Form = form;
  return this->Add(type, parameters, entry);
}

//------------------------------------------------------------------------------
std::string IgesText::Text() const
{
  const std::string unit = std::to_string(this->UnitName.size()) + "H" + this->UnitName;
  const std::vector<std::string> global =
    Wrap(std::string("1H,,1H;,4HTest,8HTest.igs,9HNURBSTrim,4HTest,32,308,15,308,15,4HTest,") +
        this->Scale + "," + std::to_string(this->UnitFlag) + "," + unit +
        ",1,0.1,15H20261121.050000,1.E-7,1000.,4HTest,4HTest,11,0,15H20261121.050000;",
      72);
  std::ostringstream text;
  text << Format("%-72sS%7d\n", "Written by a test", 1);
  for (size_t i = 0; i < global.size(); ++i)
  {
    text << Format("%-72sG%7d\n", global[i].c_str(), static_cast<int>(i + 1));
  }
  for (const std::vector<std::string>* section : { &this->Directory, &this->Parameters })
  {
    for (const std::string& line : *section)
    {
      text << line << "\n";
    }
  }
  const std::string counts = Format("S%7dG%7dD%7dP%7d", 1, static_cast<int>(global.size()),
    static_cast<int>(this->Directory.size()), static_cast<int>(this->Parameters.size()));
  text << Format("%-72sT%7d\n", counts.c_str(), 1);
  return text.str();
}

//------------------------------------------------------------------------------
void IgesText::Write(const std::string& path) const
{
  std::ofstream(path, std::ios::binary) << this->Text();
}

//------------------------------------------------------------------------------
std::string Join(const std::vector<double>& values)
{
  std::string text;
  for (double value : values)
  {
    std::string number = Format("%.17g", value);
    if (number.find_first_of(".e") == std::string::npos)
    {
      number += ".";
    }
    text += (text.empty() ? "" : ",") + number;
  }
  return text;
}

//------------------------------------------------------------------------------
std::string SurfaceParameters(const nurbs::NurbsSurface& surface)
{
  std::vector<double> values = surface.KnotsU;
  values.insert(values.end(), surface.KnotsV.begin(), surface.KnotsV.end());
  bool polynomial = true;
  for (const nurbs::Vec4& point : surface.ControlPoints)
  {
    values.push_back(point[3]);
    polynomial = polynomial && point[3] == surface.ControlPoints[0][3];
  }
  for (const nurbs::Vec4& point : surface.ControlPoints)
  {
    values.insert(values.end(), point.data(), point.data() + 3);
  }
  for (double end : { surface.FirstU(), surface.LastU(), surface.FirstV(), surface.LastV() })
  {
    values.push_back(end);
  }
  return Format("%d,%d,%d,%d,0,0,%d,0,0,", surface.CountU - 1, surface.CountV - 1, surface.DegreeU,
           surface.DegreeV, polynomial ? 1 : 0) +
    Join(values);
}
