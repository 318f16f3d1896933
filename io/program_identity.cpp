#include "io/program_identity.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

using Bytes = std::span<const unsigned char>;

/// Notes and their two parts begin at multiples of 4 bytes.
constexpr std::size_t padded(std::size_t bytes) {
  return (bytes + 3) / 4 * 4;
}

/// The build id among the notes of an ELF segment; empty if there is none.
Bytes build_id_in(Bytes notes) {
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes.data(), sizeof(head));
    const std::size_t at = sizeof(head) + padded(head.n_namesz);
    if (at > notes.size() || head.n_descsz > notes.size() - at) return {};
    if (head.n_type == NT_GNU_BUILD_ID) return notes.subspan(at, head.n_descsz);
    const std::size_t next = at + padded(head.n_descsz);
    if (next > notes.size()) return {};
    notes = notes.subspan(next);
  }
  return {};
}

/// Called for every loaded object, the program first; stops there.
int take_build_id(dl_phdr_info* object, std::size_t /*size*/, void* to) {
  for (const auto& segment : std::span(object->dlpi_phdr, object->dlpi_phnum)) {
    if (segment.p_type != PT_NOTE) continue;
    // The loader gives addresses as numbers.
    const auto* notes =
        reinterpret_cast<const unsigned char*>(object->dlpi_addr + segment.p_vaddr);  // NOLINT
    const Bytes id = build_id_in({notes, segment.p_memsz});
    if (!id.empty()) *static_cast<Bytes*>(to) = id;
  }
  return 1;
}

}  // namespace

std::string program_version() {
  return ATLASGAUGE_VERSION;
}

std::string program_identity() {
  constexpr std::size_t kShownBytes = 6;
  Bytes id;
  ::dl_iterate_phdr(take_build_id, &id);
  std::string identity = program_version();
  if (!id.empty()) identity += '-';
  for (const unsigned char byte : id.first(std::min(id.size(), kShownBytes))) {
    identity += fmt::format("{:02x}", byte);
  }
  return identity;
}

std::string program_path() {
  std::error_code fault;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", fault);
  if (fault) {
    throw Error(ErrorKind::kInternal,
                "/proc/self/exe does not name this program: " + fault.message());
  }
  return path.string();
}

}  // namespace atlasgauge
