// ies_text.h: photometric files written by a test, one part at a time.
#pragma once

#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace ninefold {

// 0, step, 2 step ... up to `last`, from `first`.
inline std::vector<double> degreesFrom(double first, double last, double step) {
  std::vector<double> angles;
  for (int i = 0; first + i * step <= last; ++i) angles.push_back(first + i * step);
  return angles;
}

// A file that is good until a test changes it: 100 cd everywhere.
struct IesText {
  std::string version = "IESNA:LM-63-2002\n[TEST] of ours\n";
  std::string tilt = "TILT=NONE\n";
  std::string lamps = "1", lumens = "-1", factor = "1", type = "1", unit = "2";
  std::string ballast = "1", third = "1";
  std::string rows, columns;  // their numbers, if they shall be wrong
  std::vector<double> vertical{0, 90, 180}, horizontal{0};
  std::function<double(double, double)> candela = [](double, double) { return 100.0; };
  std::string end = "\n";

  std::string text() const {
    std::ostringstream out;
    out.precision(17);
    out << version << tilt << lamps << ' ' << lumens << ' ' << factor << ' '
        << (rows.empty() ? std::to_string(vertical.size()) : rows) << ' '
        << (columns.empty() ? std::to_string(horizontal.size()) : columns) << ' ' << type << ' '
        << unit << " 0 0 0\n"
        << ballast << ' ' << third << " 60\n";
    for (const double v : vertical) out << v << ' ';
    out << '\n';
    for (const double h : horizontal) out << h << ' ';
    for (const double h : horizontal) {
      out << '\n';
      for (const double v : vertical) out << candela(v, h) << ' ';
    }
    out << end;
    return out.str();
  }
};

}  // namespace ninefold
