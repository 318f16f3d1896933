#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/partition.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {
namespace detail {

/// Slices of equal length, so that one slice of `record_bytes` each and the buckets for all of them
/// fit in memory.
struct Slices {
  std::uint64_t total = 0;
  std::uint64_t length = 1;

  std::size_t count() const { return static_cast<std::size_t>((total + length - 1) / length); }
  std::size_t of(std::uint64_t index) const { return static_cast<std::size_t>(index / length); }
  std::uint64_t begin(std::size_t slice) const { return slice * length; }
  std::uint64_t end(std::size_t slice) const { return std::min(total, (slice + 1) * length); }

  static Slices plan(std::uint64_t total, std::size_t record_bytes, std::uint64_t memory_bytes) {
    return {total, std::max<std::uint64_t>(1, memory_bytes / record_bytes)};
  }
};

}  // namespace detail

/// Looks up table[index] for every index, in the order of the indices, whatever that order is:
/// requests are distributed to slices of the table, answered slice by slice, and the answers
/// distributed back to slices of the output. Two sequential passes, no random access to disk, and
/// an index that occurs often costs nothing extra. Indices at or past the table's end give
/// `absent`. Consumes `indices`, at most 2^32 of them.
template <class Value>
Spill<Value> gather(const Engine& engine, Spill<std::uint32_t> indices, Spill<Value>& table,
                    const Value& absent) {
  struct Request {
    std::uint32_t index, at;
  };
  struct Answer {
    std::uint32_t at;
    Value value;
  };
  const std::uint64_t block_bytes = engine.block_bytes();
  const std::uint64_t least = 16 * block_bytes;
  const std::uint64_t useful = table.size() * sizeof(Value) * 2 + 16 * block_bytes;
  const Reservation memory =
      engine.budget.reserve_between(least, std::max(least, useful), "looking records up by index");
  const std::uint64_t slice_bytes = memory.bytes() / 2;
  const auto tables = detail::Slices::plan(table.size(), sizeof(Value), slice_bytes);
  const auto outputs = detail::Slices::plan(indices.size(), sizeof(Value), slice_bytes);
  constexpr auto kConsume = SpillReader<std::uint32_t>::Mode::kConsume;

  SpillWriter<Value> output(engine.scratch);
  if (tables.count() <= 1) {
    std::vector<Value> all(table.size());
    SpillReader<Value>(table).read(all);
    SpillReader<std::uint32_t> reader(indices, kConsume);
    for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
      for (const std::uint32_t index : block) output.push(index < all.size() ? all[index] : absent);
    }
    return output.finish();
  }

  std::vector<Spill<Request>> requests;
  {
    Partition<Request> partition(engine.scratch, tables.count() + 1);
    typename Partition<Request>::Writer writer(partition);
    SpillReader<std::uint32_t> reader(indices, kConsume);
    std::uint32_t at = 0;
    for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
      for (const std::uint32_t index : block) {
        writer.push(index < table.size() ? tables.of(index) : tables.count(), {index, at++});
      }
    }
    writer.flush();
    requests = partition.finish();
  }

  std::vector<Spill<Answer>> answers;
  {
    Partition<Answer> partition(engine.scratch, std::max<std::size_t>(1, outputs.count()));
    typename Partition<Answer>::Writer writer(partition);
    SpillReader<Value> table_reader(table);
    std::vector<Value> slice;
    for (std::size_t i = 0; i <= tables.count(); ++i) {
      const bool past_end = i == tables.count();
      slice.resize(past_end ? 0 : tables.end(i) - tables.begin(i));
      table_reader.read(slice);
      SpillReader<Request> reader(requests[i], SpillReader<Request>::Mode::kConsume);
      for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
        for (const Request& request : block) {
          const Value& value = past_end ? absent : slice[request.index - tables.begin(i)];
          writer.push(outputs.of(request.at), {request.at, value});
        }
      }
    }
    writer.flush();
    answers = partition.finish();
  }

  std::vector<Value> slice;
  for (std::size_t i = 0; i < outputs.count(); ++i) {
    slice.resize(outputs.end(i) - outputs.begin(i));
    SpillReader<Answer> reader(answers[i], SpillReader<Answer>::Mode::kConsume);
    for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
      for (const Answer& answer : block) slice[answer.at - outputs.begin(i)] = answer.value;
    }
    output.append(slice);
  }
  return output.finish();
}

}  // namespace atlasgauge
