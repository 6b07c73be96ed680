/**
 * @file TestLocale.cxx
 * @brief What is written with a decimal point whatever the user's locale: a shader, and places in
 * messages.
 */
#include "DecimalComma.h"
#include "Expect.h"
#include "FadingEdges.h"
#include "PlaceText.h"

#include <cstdio>

using namespace judge;

int main()
{
  const nurbs::Vec3 place(1.5, -2e-7, 1.0 / 3.0);
  const std::string expected = "(1.5, -2e-07, 0.333333333)";
  const std::string shader = FadingEdges();
  Expect(shader.find("smoothstep(3.000000, 10.000000, edist") != std::string::npos, shader);
  Expect(nurbs::PlaceText(place) == expected, nurbs::PlaceText(place));
  const DecimalComma comma;
  if (!comma.IsThere())
  {
    std::puts("No locale with a decimal comma here.");
    return 77;
  }
  Expect(FadingEdges() == shader, "with a decimal comma: " + FadingEdges());
  Expect(nurbs::PlaceText(place) == expected, "with a decimal comma: " + nurbs::PlaceText(place));
  return Wrong != 0;
}
