// SPDX-License-Identifier: GPL-2.0-only

#include "aleisph_record.h"

#include <cstring>
#include <sstream>

namespace aleisph {
namespace {

constexpr std::size_t MARK_SIZE = 8;
constexpr char MARK[MARK_SIZE + 1] = "ALEISPH:";
constexpr std::size_t NUMBERS = MARK_SIZE, SUM = NUMBERS + 2 * sizeof(std::int32_t),
                      VALUES = SUM + sizeof(std::uint64_t);

template <class T> T read(const char *from)
{
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

template <class T> void write(T value, char *to)
{
  std::memcpy(to, &value, sizeof(T));
}

}    // namespace

std::uint64_t checksum(const void *data, std::size_t n, std::uint64_t before)
{
  const auto *bytes = static_cast<const unsigned char *>(data);
  std::uint64_t sum = before;
  for (std::size_t k = 0; k < n; k++) sum = (sum ^ bytes[k]) * 1099511628211ull;
  return sum;
}

Record::Record(const std::string &style, int version, const std::vector<Value> &values) :
    style_(style), version_(version), values_(values)
{
}

std::uint64_t Record::sum(const char *numbers, const char *values) const
{
  const std::uint64_t head = checksum(numbers, SUM - NUMBERS,
                                      checksum(style_.data(), style_.size()));
  return checksum(values, values_.size() * sizeof(double), head);
}

std::vector<char> Record::pack(const std::vector<double> &values) const
{
  std::vector<char> data(VALUES + values.size() * sizeof(double));
  std::memcpy(data.data(), MARK, MARK_SIZE);
  write<std::int32_t>(version_, &data[NUMBERS]);
  write<std::int32_t>(static_cast<std::int32_t>(values.size()),
                      &data[NUMBERS + sizeof(std::int32_t)]);
  for (std::size_t k = 0; k < values.size(); k++)
    write(values[k], &data[VALUES + k * sizeof(double)]);
  write(sum(&data[NUMBERS], data.data() + VALUES), &data[SUM]);
  return data;
}

std::string Record::unpack(const char *data, std::vector<double> &values) const
{
  if (std::memcmp(data, MARK, MARK_SIZE) != 0)
    return "is damaged, or of a version before records had a mark";
  const auto version = read<std::int32_t>(data + NUMBERS);
  const auto count = read<std::int32_t>(data + NUMBERS + sizeof(std::int32_t));
  std::ostringstream text;
  if (version != version_ || count != static_cast<std::int32_t>(values_.size())) {
    text << "is of version " << version << " with " << count << " values, not of version "
         << version_ << " with " << values_.size();
    return text.str();
  }
  if (read<std::uint64_t>(data + SUM) != sum(data + NUMBERS, data + VALUES))
    return "is damaged, or of another style: its checksum is wrong";
  std::vector<double> found;
  for (std::size_t k = 0; k < values_.size(); k++) {
    const auto value = read<double>(data + VALUES + k * sizeof(double));
    if (!(value >= values_[k].low && value <= values_[k].high)) {
      text << "has " << value << " as " << values_[k].name << ", which must lie between "
           << values_[k].low << " and " << values_[k].high;
      return text.str();
    }
    found.push_back(value);
  }
  values = found;
  return "";
}

}    // namespace aleisph
