#include "unilateral/mesh/faces_between_parts.h"

#include "unilateral/base/exchange_records.h"
#include "unilateral/base/sort_unique.h"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <utility>

namespace unilateral
{
  namespace
  {
    /// A face that was sent here.
    struct SentFace
    {
      FaceOfPart    face;
      std::uint32_t rank, place; ///< where it came from
    };

    struct Answer
    {
      std::uint32_t on_cut, name;
    };

    /// All pieces are one, by these pairs of pieces with a common face, of all processes.
    bool are_one(std::vector<std::array<std::uint32_t, 4>> links, const unsigned n_pieces, const Processes &processes)
    {
      sort_unique(links);
      links = processes.gather(links);
      const auto               n_of_each = processes.gather(std::vector<std::uint32_t>{n_pieces});
      std::vector<std::size_t> first(1, 0);
      for (const auto n : n_of_each)
        first.push_back(first.back() + n);
      boost::disjoint_sets_with_storage<> sets(first.back());
      for (const auto &[rank, piece, other_rank, other] : links)
        sets.union_set(first[rank] + piece, first[other_rank] + other);
      for (std::size_t k = 1; k < first.back(); ++k)
        if (sets.find_set(k) != sets.find_set(std::size_t(0)))
          return false;
      return true;
    }
  } // namespace

  FacesBetweenParts find_faces_between_parts(const std::vector<FaceOfPart> &own,
                                             const std::vector<NamedFace>  &named,
                                             const unsigned                 n_pieces,
                                             const Processes               &processes)
  {
    const unsigned                       n = processes.size();
    std::vector<std::vector<FaceOfPart>> faces_to(n);
    std::vector<std::vector<NamedFace>>  names_to(n);
    for (const auto &face : own)
      faces_to[face.vertices[0] % n].push_back(face);
    for (const auto &face : named)
      names_to[face.vertices[0] % n].push_back(face);

    std::vector<SentFace> faces;
    const auto            received = exchange_records(faces_to, processes);
    for (std::uint32_t rank = 0; rank < n; ++rank)
      for (std::uint32_t k = 0; k < received[rank].size(); ++k)
        faces.push_back({received[rank][k], rank, k});
    std::sort(faces.begin(), faces.end(), [](const SentFace &a, const SentFace &b) { return a.face.vertices < b.face.vertices; });
    std::vector<NamedFace> names;
    for (const auto &from_one : exchange_records(names_to, processes))
      names.insert(names.end(), from_one.begin(), from_one.end());
    std::sort(names.begin(), names.end(),
              [](const NamedFace &a, const NamedFace &b)
              { return a.vertices != b.vertices ? a.vertices < b.vertices : a.number < b.number; });

    FacesBetweenParts                         result;
    std::vector<std::array<std::uint32_t, 4>> links;
    std::vector<std::vector<Answer>>          answers(n);
    for (std::uint32_t rank = 0; rank < n; ++rank)
      answers[rank].resize(received[rank].size());
    for (auto first = faces.begin(), end = first; first != faces.end(); first = end)
    {
      end = std::find_if(first, faces.end(), [&](const SentFace &face) { return face.face.vertices != first->face.vertices; });
      const bool on_cut = end - first == 2;
      const auto name = std::lower_bound(names.begin(), names.end(), first->face.vertices,
                                         [](const NamedFace &a, const FaceByIds &vertices) { return a.vertices < vertices; });
      const bool has_name = name != names.end() && name->vertices == first->face.vertices;
      for (auto face = first; face != end; ++face)
        answers[face->rank][face->place] = {on_cut, has_name ? name->name : no_name};
      if (end - first == 1)
        continue;
      const auto second = first + 1;
      result.fit = result.fit && on_cut && first->rank != second->rank && (first->face.side == 0 || first->face.side != second->face.side);
      links.push_back({first->rank, first->face.piece, second->rank, second->face.piece});
    }
    result.hold_together = are_one(std::move(links), n_pieces, processes);

    const auto               answered = exchange_records(answers, processes);
    std::vector<std::size_t> next(n, 0);
    for (const auto &face : own)
    {
      const unsigned home = face.vertices[0] % n;
      const Answer  &answer = answered[home][next[home]++];
      result.faces.push_back({answer.on_cut != 0, answer.name});
    }
    return result;
  }
} // namespace unilateral
