// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_fluid.h"

#include <cmath>
#include <map>
#include <sstream>

namespace aleisph {

namespace {

std::string at_line(int number, const std::string &what)
{
  return "line " + std::to_string(number) + ": " + what;
}

bool parse_number(const std::string &word, double &value)
{
  std::size_t used = 0;
  try {
    value = std::stod(word, &used);
  } catch (const std::exception &) {
    return false;
  }
  return used == word.size() && std::isfinite(value);
}

}    // namespace

std::string read_fluid(std::istream &in, FluidProperties &fluid)
{
  fluid = FluidProperties();
  std::map<std::string, double *> fields = {
      {"rho0", &fluid.rho0}, {"nu", &fluid.nu}, {"sigma", &fluid.sigma}};
  std::map<std::string, bool> seen;

  std::string line;
  for (int number = 1; std::getline(in, line); number++) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string name, word, extra;
    if (!(words >> name)) continue;
    const auto field = fields.find(name);
    if (field == fields.end()) return at_line(number, "unknown property '" + name + "'");
    if (seen[name]) return at_line(number, "'" + name + "' given twice");
    seen[name] = true;
    if (!(words >> word)) return at_line(number, "no value after '" + name + "'");
    if (!parse_number(word, *field->second) || *field->second < 0.0)
      return at_line(number, "'" + word + "' is not a non-negative number");
    if (words >> extra) return at_line(number, "unexpected '" + extra + "'");
  }
  if (!(fluid.rho0 > 0.0)) return "no 'rho0' line with a positive density";
  return "";
}

}    // namespace aleisph
