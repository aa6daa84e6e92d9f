// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Wrong input must end in an error that names the command, the value and
   the remedy. A case is a small channel with something wrong in it.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TEST_ERRORS_H
#define LMP_ALEISPH_TEST_ERRORS_H

#include "script.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <functional>

// what the message must contain
using Words = std::vector<std::string>;

inline void expect_words(const std::string &message, const Words &words)
{
  std::string missing;
  for (const auto &word : words)
    if (message.find(word) == std::string::npos) missing += " '" + word + "'";
  if (message.empty())
    ADD_FAILURE() << "no error";
  else
    EXPECT_EQ(missing, "") << "these are missing in: " << message;
}

// 10 x 9 fluid particles between two walls, at rest, spacing 0.2, mass 0.04
inline Scene small_channel()
{
  return channel(5, 10);
}

inline Script small_script()
{
  Script s = script_of(small_channel());
  s.timestep = "timestep 0.01";
  return s;
}

// The script must be right as it stands, or the errors that follow may have another reason
struct ErrorCase {
  std::string name;
  std::function<void(Script &)> spoil;
  Words words;
};

inline void expect_errors(const std::vector<ErrorCase> &cases, const std::string &last = "run 1")
{
  for (const auto &item : cases) {
    SCOPED_TRACE(item.name);
    Simulation sim(small_channel());
    Script script = small_script();
    item.spoil(script);
    expect_words(sim.error_of(script.text() + last), item.words);
  }
}

// the number behind `phrase` in a message
inline double number_after(const std::string &message, const std::string &phrase)
{
  const auto at = message.find(phrase);
  if (at == std::string::npos) {
    ADD_FAILURE() << "'" << phrase << "' is missing in: " << message;
    return 0.0;
  }
  return std::stod(message.substr(at + phrase.size()));
}

#endif
