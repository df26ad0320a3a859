// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/serialization.h>

#include <cstdint>
#include <functional>
#include <string>

#include "core/archive/archive.h"
#include "core/config/field_values.h"
#include "ros/replicas/hashed_cache.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {

/// A message as bytes, and back. @throws std::exception for bytes that are no such message.
template <class Message>
std::string bytesOf(const Message& message) {
  std::string out(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(out.data()),
                                     static_cast<std::uint32_t>(out.size()));
  ros::serialization::serialize(stream, message);
  return out;
}
template <class Message>
Message messageOf(std::string bytes) {
  ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  Message out;
  ros::serialization::deserialize(stream, out);
  return out;
}

/// Writes or reads the named values of a tuning.
void archiveNames(Archive& a, NamedValues& named);

/// Winds to which events refer by their hashes, as bytes: empty for an unknown hash.
std::string windBytes(const HashedCache<wind::Field>& winds, std::uint64_t hash);
/// Reads a wind with all stamps moved. @throws InvalidInput for bytes that are no wind.
wind::Field windOfBytes(const std::string& bytes, Nanoseconds shift);

/// The bodies of SavedNode::inputOf() and readInput() of a node whose one input is the wind.
template <class Event>
std::string windInputOf(const HashedCache<wind::Field>& winds, const Event& event) {
  return event.kind == Event::WIND ? windBytes(winds, event.wind_hash) : std::string();
}
template <class Event>
std::function<void()> readWindInput(HashedCache<wind::Field>& winds, Event& event,
                                    const std::string& bytes, Nanoseconds shift) {
  const wind::Field wind = windOfBytes(bytes, shift);
  event.wind_hash = wind.hash();
  return [&winds, wind] { winds.keep(wind.hash(), wind); };
}

}  // namespace vegetation_sim
