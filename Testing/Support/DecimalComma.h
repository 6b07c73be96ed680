/**
 * @file DecimalComma.h
 * @brief The locale of users who write a comma before the decimals.
 */
#ifndef DecimalComma_h
#define DecimalComma_h

#include <clocale>
#include <cstdlib>
#include <string>

/// While it lives the program has such a locale: the machine's, or one made for it.
class DecimalComma
{
public:
  DecimalComma()
    : Before(std::setlocale(LC_ALL, nullptr))
  {
    for (const char* name : { "de_DE.UTF-8", "fr_FR.UTF-8", "pt_PT.UTF-8" })
    {
      if (std::setlocale(LC_ALL, name))
      {
        return;
      }
    }
    std::string directory = "/tmp/decimal-comma-XXXXXX";
    if (mkdtemp(directory.data()))
    {
      const std::string make =
        "localedef -i de_DE -f UTF-8 " + directory + "/comma >/dev/null 2>&1";
      setenv("LOCPATH", directory.c_str(), 1);
      if (std::system(make.c_str()) == 0)
      {
        std::setlocale(LC_ALL, "comma");
      }
      unsetenv("LOCPATH");
      std::system(("rm -rf " + directory).c_str());
    }
  }
  ~DecimalComma() { std::setlocale(LC_ALL, this->Before.c_str()); }
  DecimalComma(const DecimalComma&) = delete;
  void operator=(const DecimalComma&) = delete;

  /// False where the machine has neither one nor what makes one.
  static bool IsThere() { return *std::localeconv()->decimal_point == ','; }

private:
  const std::string Before;
};

#endif
