/**
 * @file FadingEdges.h
 * @brief Edges of elements that fade where there is no room for them.
 */
#ifndef FadingEdges_h
#define FadingEdges_h

#include <locale>
#include <sstream>
#include <string>

/// Pixels: where no height of a facet's triangles is larger its edges cannot be seen.
inline constexpr double InvisibleEdges = 3.0;
/// Where none is smaller, they are as always.
inline constexpr double FullEdges = 10.0;

/// A replacement in the fragment shader of "Surface With Edges". There edist holds the distances,
/// in pixels, to the sides of the triangle; their sum lies between its least and its largest
/// height. All on one line: where no edges are drawn, the tag stays, a comment that takes the rest
/// with it.
inline std::string FadingEdges()
{
  std::ostringstream text;
  text.imbue(std::locale::classic()); // a decimal point whatever the user's locale
  text << std::fixed
       << R"json({"type" : "fragment", "original" : "//VTK::Edges::Impl", )json"
          R"json("replacement" : "vec3 bareDiffuse = diffuseColor; )json"
          R"json(vec3 bareAmbient = ambientColor; //VTK::Edges::Impl )json"
          R"json(float fade = smoothstep()json"
       << InvisibleEdges << ", " << FullEdges
       << R"json(, edist[0] + edist[1] + edist[2]); )json"
          R"json(diffuseColor = mix(bareDiffuse, diffuseColor, fade); )json"
          R"json(ambientColor = mix(bareAmbient, ambientColor, fade);"})json";
  return text.str();
}

#endif
