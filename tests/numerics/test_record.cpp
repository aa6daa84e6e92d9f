// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Records of restart files: what was written comes back to the bit, and
   whatever else comes is refused.
------------------------------------------------------------------------- */

#include "aleisph_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using aleisph::Record;

namespace {

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

Record example(const std::string &style = "aleisph/example", int version = 2)
{
  return {style, version, {{"dt", 0.0, 1.0e30}, {"count", 0.0, Record::MANY}}};
}

std::string refusal(const Record &reader, const std::vector<char> &data)
{
  std::vector<double> values = {7.0};
  const std::string wrong = reader.unpack(data.data(), values);
  // nothing is taken of a record that is refused
  EXPECT_EQ(values, wrong.empty() ? values : std::vector<double>{7.0});
  return wrong;
}

}    // namespace

TEST(Record, ComesBackToTheBit)
{
  const std::vector<double> written = {std::nextafter(0.1, 1.0), 3.0};
  std::vector<double> values;
  EXPECT_EQ(example().unpack(example().pack(written).data(), values), "");
  EXPECT_EQ(values, written);
}

TEST(Record, EveryDamagedByteIsSeen)
{
  const auto right = example().pack({0.25, 3.0});
  for (std::size_t k = 0; k < right.size(); k++)
    for (int bit = 0; bit < 8; bit++) {
      auto data = right;
      data[k] = static_cast<char>(data[k] ^ (1 << bit));
      EXPECT_NE(refusal(example(), data), "") << "byte " << k << ", bit " << bit;
    }
}

// Numbers put into the file without a checksum of their own, of which one version took 196 of 200
TEST(Record, WrongNumbersAreSeen)
{
  const auto right = example().pack({0.25, 3.0});
  for (const double wrong : {NOT_A_NUMBER, -1.0, HUGE_VAL, -HUGE_VAL, 1.0e300, 0.0})
    for (int k = 0; k < 2; k++) {
      auto data = right;
      std::memcpy(data.data() + data.size() - 8 * (2 - k), &wrong, sizeof(wrong));
      EXPECT_NE(refusal(example(), data).find("checksum"), std::string::npos);
    }
}

// Even where the checksum is right
TEST(Record, ValuesHaveARange)
{
  for (const double wrong : {NOT_A_NUMBER, -1.0, HUGE_VAL, 1.0e300}) {
    const auto message = refusal(example(), example().pack({wrong, 3.0}));
    EXPECT_NE(message.find("as dt, which must lie between 0 and 1e+30"), std::string::npos);
  }
}

TEST(Record, OfAnother)
{
  EXPECT_NE(refusal(example(), example("aleisph/other").pack({0.25, 3.0})).find("another style"),
            std::string::npos);
  const auto message = refusal(example(), example("aleisph/example", 1).pack({0.25, 3.0}));
  EXPECT_NE(message.find("version 1 with 2 values, not of version 2 with 2"), std::string::npos);
}

// One double and nothing else, as it was: no byte behind it is read
TEST(Record, OlderThanRecords)
{
  std::vector<char> data(sizeof(double));
  const double valid = 1.0;
  std::memcpy(data.data(), &valid, sizeof(valid));
  EXPECT_NE(refusal(example(), data).find("of a version before records had a mark"),
            std::string::npos);
}
