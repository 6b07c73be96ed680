/**
 * @file IgesText.h
 * @brief Writes IGES files entity by entity, for tests that need full control of their content.
 */
#ifndef IgesText_h
#define IgesText_h

#include "NurbsSurface.h"

#include <string>
#include <vector>

class IgesText
{
public:
  /// What the directory entry says beside the type.
  struct Entry
  {
    int Form = 0;
    int Subordinate = 0; ///< 1: owned by another entity
    int Transform = 0;   ///< directory entry of a matrix, type 124
    std::string Label;   ///< up to eight characters
    int Subscript = 0;
  };

  /// @param unit flag and name of the unit: 1 "INCH", 2 "MM", 6 "M", ...
  /// @param scale of the model, as the file gives it.
  explicit IgesText(int unitFlag = 2, std::string unitName = "MM", std::string scale = "1.")
    : UnitFlag(unitFlag)
    , UnitName(std::move(unitName))
    , Scale(std::move(scale))
  {
  }

  /// Adds an entity; `parameters` are what follows the type number, separated by commas.
  /// @return its directory entry, by which other entities point to it.
  int Add(int type, const std::string& parameters, const Entry& entry);
  int Add(int type, const std::string& parameters) { return this->Add(type, parameters, Entry()); }
  /// An entity that another one owns.
  int AddOwned(int type, const std::string& parameters, int form = 0);

  void Write(const std::string& path) const;
  std::string Text() const;

private:
  int UnitFlag;
  std::string UnitName;
  std::string Scale;
  std::vector<std::string> Directory;
  std::vector<std::string> Parameters;
};

/// Numbers with all their digits, separated by commas.
std::string Join(const std::vector<double>& values);

/// The parameters of a surface of type 128.
std::string SurfaceParameters(const nurbs::NurbsSurface& surface);

#endif
