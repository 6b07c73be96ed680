#include "BestLayer.h"

#include "Team.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

namespace trim
{
namespace
{

/// A band with so many is a large one.
constexpr int ManyElements = 10000;

}

BestLayer::BestLayer(const TrimBand& near, const BandTask& task)
  : Near(near)
  , Task(task)
{
}

std::unique_ptr<TrimBand> BestLayer::Find(
  const Shortcomings& limit, bool known, const Progress& progress)
{
  if (this->MadeFor != this->Near.Structure.Column)
  {
    this->MadeFor = this->Near.Structure.Column;
    this->Trims = {};
  }
  if ((limit.Elements > 0 && this->GivesUp) || (this->Limit && *this->Limit < limit))
  {
    // What was given up may be less bad than that, and is to be made after all.
    this->GivesUp = limit.Elements == 0;
    this->Trims = {};
  }
  if (known)
  {
    this->Limit = limit;
  }
  if (!this->Before)
  {
    this->Before = std::make_shared<const Band>(this->Near.Mesh);
  }
  const bool isNew = std::none_of(
    this->Trims.begin(), this->Trims.end(), [](const auto& made) { return made.has_value(); });
  constexpr auto count = static_cast<double>(Kinds.size());
  // In a large band threads share the work on one, and none need be made in vain.
  const std::size_t ahead = this->Near.Mesh.NumberOfElements() < ManyElements ? 0 : 1;
  std::unique_ptr<TrimBand> best;
  std::size_t ofBest = 0;
  for (std::size_t i = 0; i < Kinds.size() && !(best && best->NodesLeft.empty()) &&
       !progress(static_cast<double>(i) / count);
       ++i)
  {
    if (Kinds[i].MayBeBare && best && MeasureLeft(*best) < limit)
    {
      break;
    }
    if (isNew && i == ahead && Team::Current())
    {
      this->MakeAhead(i, progress);
    }
    const double done = static_cast<double>(i) / count;
    auto& made = this->Trims[i];
    std::unique_ptr<TrimBand> own =
      made ? std::move(*made) : this->Make(i, Part(progress, done, done + 1.0 / count));
    made = nullptr;
    if (own && (!best || MeasureLeft(*own) < MeasureLeft(*best)))
    {
      best = std::move(own);
      ofBest = i;
    }
  }
  if (best && !(MeasureLeft(*best) < limit))
  {
    this->Trims[ofBest] = std::move(best);
    return nullptr;
  }
  return best;
}

std::unique_ptr<TrimBand> BestLayer::FindWhole(const Shortcomings& most, const Progress& progress)
{
  if (!this->Limit)
  {
    this->Limit = most;
  }
  Shortcomings least;
  least.Squares = std::numeric_limits<double>::min();
  return this->Find(least, false, progress);
}

std::unique_ptr<TrimBand> BestLayer::Make(std::size_t trim, const Progress& progress) const
{
  return TrimWithLayer(
    this->Near, this->Before, Kinds[trim], { this->GivesUp, this->Limit }, this->Task, progress);
}

/// Makes all of them from one on at once, by threads, but for those that may have bare nodes; those
/// after one that leaves nothing end, as hardly anybody will ask for them.
void BestLayer::MakeAhead(std::size_t first, const Progress& progress)
{
  const Id count = static_cast<Id>(std::count_if(
    Kinds.begin(), Kinds.end(), [](const LayerKind& kind) { return !kind.MayBeBare; }));
  std::atomic<Id> last{ count };
  ParallelFor(static_cast<Id>(first), count, 1,
    [&](Id begin, Id end)
    {
      for (Id trim = begin; trim < end; ++trim)
      {
        auto made = this->Make(trim, [&](double) { return trim > last || progress(-1.0); });
        const bool leavesNone = made && made->NodesLeft.empty();
        for (Id before = last; leavesNone && trim < before;)
        {
          last.compare_exchange_weak(before, trim);
        }
        if (trim <= last) // else it may have ended early
        {
          this->Trims[trim] = std::move(made);
        }
      }
    });
}

}
