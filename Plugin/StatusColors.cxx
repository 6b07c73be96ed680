#include "StatusColors.h"

#include "vtkSMSettings.h"

namespace
{
/// ParaView looks up array_lookup_tables.<array name> when an array is first used for colouring.
/// A legend names a value if it has an annotation (value, name, value, name, ...) and the map is
/// indexed. Never rescaled: the values are categories.
/// What is not computed far from the cut is grey: in ParaView's yellow for NaN it would draw all
/// the attention.
const char* const Colors = R"json({
  "array_lookup_tables" :
  {
    "NodeStatus" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "keep", "1", "eliminate", "2", "on surface" ],
      "IndexedColors" : [ 0.65, 0.79, 0.90,  0.55, 0.55, 0.55,  0.84, 0.19, 0.15 ],
      "IndexedOpacities" : [ 1, 1, 1 ] } },
    "ElementStatus" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "keep", "1", "eliminate", "2", "to treat" ],
      "IndexedColors" : [ 0.65, 0.79, 0.90,  0.55, 0.55, 0.55,  0.99, 0.72, 0.26 ],
      "IndexedOpacities" : [ 1, 1, 1 ] } },
    "CorrectionApplied" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "none", "2", "type II", "3", "type III", "4", "relaxed" ],
      "IndexedColors" : [ 0.85, 0.85, 0.85,  0.12, 0.47, 0.71,  0.89, 0.40, 0.10,
        0.60, 0.31, 0.64 ],
      "IndexedOpacities" : [ 1, 1, 1, 1 ] } },
    "Rescue" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "not needed", "1", "relaxed", "2", "other treatment",
        "3", "other correction", "4", "other fate", "5", "left off the surface" ],
      "IndexedColors" : [ 0.85, 0.85, 0.85,  0.60, 0.31, 0.64,  0.99, 0.72, 0.26,
        0.12, 0.47, 0.71,  0.89, 0.40, 0.10,  0.84, 0.19, 0.15 ],
      "IndexedOpacities" : [ 1, 1, 1, 1, 1, 1 ] } },
    "Feasibility" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "as assumed", "1", "sharp bend or edge", "2", "inclined",
        "3", "narrow hole", "4", "edge crossed twice", "5", "cut-out not opened",
        "6", "open seam" ],
      "IndexedColors" : [ 0.85, 0.85, 0.85,  0.99, 0.72, 0.26,  0.60, 0.31, 0.64,
        0.12, 0.47, 0.71,  0.89, 0.40, 0.10,  0.84, 0.19, 0.15,  0.20, 0.20, 0.20 ],
      "IndexedOpacities" : [ 1, 1, 1, 1, 1, 1, 1 ] } },
    "Shortfall" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "none", "1", "below the quality floor", "2", "left off the surface",
        "3", "invalid", "4", "invalid as it came", "5", "short edge",
        "6", "loose part" ],
      "IndexedColors" : [ 0.85, 0.85, 0.85,  0.99, 0.72, 0.26,  0.89, 0.40, 0.10,
        0.84, 0.19, 0.15,  0.60, 0.31, 0.64,  0.12, 0.47, 0.71,  0.20, 0.63, 0.17 ],
      "IndexedOpacities" : [ 1, 1, 1, 1, 1, 1, 1 ] } },
    "SignedDistance" : { "PVLookupTable" : { "NanColor" : [ 0.55, 0.55, 0.55 ] } },
    "ScaledJacobian" : { "PVLookupTable" : { "NanColor" : [ 0.55, 0.55, 0.55 ] } },
    "NewBoundary" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "other", "1", "new border" ],
      "IndexedColors" : [ 0.85, 0.85, 0.85,  0.12, 0.47, 0.71 ],
      "IndexedOpacities" : [ 1, 1 ] } },
    "Inserted" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "of the input", "1", "inserted" ],
      "IndexedColors" : [ 0.85, 0.85, 0.85,  0.12, 0.47, 0.71 ],
      "IndexedOpacities" : [ 1, 1 ] } },
    "CornerLost" : { "PVLookupTable" : {
      "IndexedLookup" : 1,
      "AutomaticRescaleRangeMode" : -1,
      "Annotations" : [ "0", "none", "1", "corner lost" ],
      "IndexedColors" : [ 0.85, 0.85, 0.85,  0.84, 0.19, 0.15 ],
      "IndexedOpacities" : [ 1, 1 ] } }
  }
})json";

/// Below the user's settings and a site's, as ParaView's own defaults for arrays.
constexpr double Priority = 0.0;
}

void RegisterStatusColors()
{
  vtkSMSettings* settings = vtkSMSettings::GetInstance();
  // Loaded by client and built-in server alike: once is enough.
  if (!settings->HasSetting(".array_lookup_tables.NodeStatus", Priority))
  {
    settings->AddCollectionFromString(Colors, Priority);
  }
}
