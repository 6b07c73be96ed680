#include "ArrayRanges.h"

#include "Runs.h"
#include "WideLanes.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkInformationInformationVectorKey.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkSMPTools.h>
#include <vtkSetGet.h>
#include <vtkTypeTraits.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

namespace trim
{
namespace
{

/// Tuples for a thread at a time.
constexpr vtkIdType Grain = 50000;
/// Tuples that stay in a near cache with their magnitudes.
constexpr vtkIdType CachedTuples = 4096;
/// Values for whose least and largest ones there are registers, and which tuples of one to four
/// components fill evenly.
template <typename Value>
constexpr int LanesOf = sizeof(Value) < 8 ? 48 : 24;

/// Least and largest value; where there is none, as VTK tells it. NaN counts for nothing.
template <typename Value>
struct Range
{
  Value Least = vtkTypeTraits<Value>::Max();
  Value Largest = vtkTypeTraits<Value>::Min();

  void Add(Value value)
  {
    this->Least = value < this->Least ? value : this->Least;
    this->Largest = value > this->Largest ? value : this->Largest;
  }
  void Add(const Range& other)
  {
    this->Least = std::min(this->Least, other.Least);
    this->Largest = std::max(this->Largest, other.Largest);
  }
  bool IsFinite() const
  {
    return std::isfinite(static_cast<double>(this->Least)) &&
      std::isfinite(static_cast<double>(this->Largest));
  }
  std::array<double, 2> AsDoubles() const
  {
    return { static_cast<double>(this->Least), static_cast<double>(this->Largest) };
  }
};

/// The ranges of so many values side by side, again and again: lanes, for the compiler to take in
/// one step. Each lane belongs to one component.
template <int Lanes, bool Finite, typename Value>
void AddLanes(const Value* value, vtkIdType rows, Range<Value>* components, int count)
{
  std::array<Value, Lanes> least;
  std::array<Value, Lanes> largest;
  least.fill(Range<Value>().Least);
  largest.fill(Range<Value>().Largest);
  for (vtkIdType row = 0; row < rows; ++row, value += Lanes)
  {
    for (int i = 0; i < Lanes; ++i)
    {
      const Value v = value[i];
      const bool counts = !Finite || !std::isinf(static_cast<double>(v));
      least[i] = counts && v < least[i] ? v : least[i];
      largest[i] = counts && v > largest[i] ? v : largest[i];
    }
  }
  for (int i = 0; i < Lanes; ++i)
  {
    components[i % count].Add({ least[i], largest[i] });
  }
}

/// The same for so many values, whatever their number.
template <bool Finite, typename Value>
void AddValues(const Value* values, vtkIdType size, Range<Value>* components, int count)
{
  constexpr int lanes = LanesOf<Value>;
  vtkIdType done = 0;
  if (lanes % count == 0)
  {
    AddLanes<lanes, Finite>(values, size / lanes, components, count);
    done = size / lanes * lanes;
  }
  for (vtkIdType i = done; i < size; ++i)
  {
    AddLanes<1, Finite>(values + i, 1, components + i % count, 1);
  }
}

/// Squared magnitudes of tuples. Size: the number of components where it is known to the compiler,
/// else 0.
template <int Size, typename Value>
void Square(const Value* value, int components, vtkIdType count, double* squares)
{
  const int size = Size > 0 ? Size : components;
  for (vtkIdType i = 0; i < count; ++i)
  {
    double sum = 0.0;
    for (int c = 0; c < size; ++c)
    {
      const auto v = static_cast<double>(value[i * size + c]);
      sum += v * v;
    }
    squares[i] = sum;
  }
}

/// Of a piece of an array, or of all of it.
template <typename Value>
struct Ranges
{
  std::vector<Range<Value>> Components;
  Range<double> Squares; ///< of magnitudes, squared; of tuples of several components
};

/// An array's memory, tuple by tuple.
template <typename Value>
struct Tuples
{
  const Value* Values;
  vtkIdType Count;
  int Components;

  /// With Finite, infinite values count for nothing.
  template <bool Finite>
  Ranges<Value> Find() const
  {
    std::vector<Ranges<Value>> found(NumberOfRuns(this->Count, Grain));
    ForRuns(this->Count, Grain,
      [&](vtkIdType piece, vtkIdType begin, vtkIdType end)
      {
        Ranges<Value> own{ std::vector<Range<Value>>(this->Components), {} };
        nurbs::WithWideLanes([&](auto) { this->Add<Finite>(begin, end, own); });
        found[piece] = std::move(own);
      });
    Ranges<Value> all{ std::vector<Range<Value>>(this->Components), {} };
    for (const auto& piece : found)
    {
      for (int c = 0; c < this->Components; ++c)
      {
        all.Components[c].Add(piece.Components[c]);
      }
      all.Squares.Add(piece.Squares);
    }
    return all;
  }

private:
  /// Of the tuples from begin to end, which are read from memory once.
  template <bool Finite>
  void Add(vtkIdType begin, vtkIdType end, Ranges<Value>& ranges) const
  {
    std::array<double, CachedTuples> squares;
    for (vtkIdType next; begin < end; begin = next)
    {
      next = this->Components > 1 ? std::min(end, begin + CachedTuples) : end;
      const vtkIdType count = next - begin;
      const Value* const first = this->Values + begin * this->Components;
      AddValues<Finite>(
        first, count * this->Components, ranges.Components.data(), this->Components);
      if (this->Components > 1)
      {
        this->Components == 3 ? Square<3>(first, 3, count, squares.data())
                              : Square<0>(first, this->Components, count, squares.data());
        AddValues<Finite>(squares.data(), count, &ranges.Squares, 1);
      }
    }
  }
};

template <typename Value>
void SetComponents(vtkDataArray* array, vtkInformationInformationVectorKey* key,
  const std::vector<Range<Value>>& ranges)
{
  vtkNew<vtkInformationVector> components;
  components->SetNumberOfInformationObjects(static_cast<int>(ranges.size()));
  for (std::size_t c = 0; c < ranges.size(); ++c)
  {
    const auto range = ranges[c].AsDoubles();
    components->GetInformationObject(static_cast<int>(c))
      ->Set(vtkDataArray::COMPONENT_RANGE(), range.data(), 2);
  }
  array->GetInformation()->Set(key, components);
}

void SetNorm(vtkDataArray* array, vtkInformationDoubleVectorKey* key, const Range<double>& squares)
{
  const std::array<double, 2> range{ std::sqrt(squares.Least), std::sqrt(squares.Largest) };
  array->GetInformation()->Set(key, range.data(), 2);
}

/// Tells an array the ranges of some tuples.
template <typename Value>
void Tell(vtkDataArray* array, const Value* values, vtkIdType count)
{
  const Tuples<Value> tuples{ values, count, array->GetNumberOfComponents() };
  const auto ranges = tuples.template Find<false>();
  const bool finite = std::all_of(ranges.Components.begin(), ranges.Components.end(),
    [](const auto& range) { return range.IsFinite(); });
  const bool finiteSquares = ranges.Squares.IsFinite();
  auto ofFinite = ranges;
  if constexpr (std::is_floating_point_v<Value>)
  {
    if (!finite || !finiteSquares)
    {
      ofFinite = tuples.template Find<true>();
    }
  }
  SetComponents(array, vtkAbstractArray::PER_COMPONENT(), ranges.Components);
  SetComponents(array, vtkAbstractArray::PER_FINITE_COMPONENT(),
    finite ? ranges.Components : ofFinite.Components);
  if (tuples.Components > 1)
  {
    SetNorm(array, vtkDataArray::L2_NORM_RANGE(), ranges.Squares);
    SetNorm(array, vtkDataArray::L2_NORM_FINITE_RANGE(),
      finiteSquares ? ranges.Squares : ofFinite.Squares);
  }
}

class PointsOfRanges : public vtkPoints
{
public:
  static PointsOfRanges* New();
  vtkTypeMacro(PointsOfRanges, vtkPoints);

  void ComputeBounds() override
  {
    if (this->GetNumberOfPoints() == 0)
    {
      this->Superclass::ComputeBounds();
    }
    else if (this->GetMTime() > this->ComputeTime)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Data->GetRange(this->Bounds + 2 * axis, axis);
      }
      this->ComputeTime.Modified();
    }
  }
};
vtkStandardNewMacro(PointsOfRanges);

/// The tuples at these places, and zeros for all others.
template <typename Value>
std::vector<Value> Listed(const Value* values, int components, const std::vector<vtkIdType>& places)
{
  std::vector<Value> listed(components, Value(0));
  listed.reserve(components * (places.size() + 1));
  for (const vtkIdType place : places)
  {
    listed.insert(listed.end(), values + components * place, values + components * (place + 1));
  }
  return listed;
}

template <typename Value>
void TellListed(vtkDataArray* array, const Value* values, const std::vector<vtkIdType>& places)
{
  const auto listed = Listed(values, array->GetNumberOfComponents(), places);
  Tell(array, listed.data(), static_cast<vtkIdType>(places.size() + 1));
}

bool CanBeTold(vtkDataArray* array)
{
  return array && array->GetNumberOfTuples() > 0 && array->HasStandardMemoryLayout() &&
    !(array->HasInformation() && array->GetInformation()->Has(vtkAbstractArray::PER_COMPONENT()));
}

}

void TellRanges(vtkDataArray* array, const std::vector<vtkIdType>& places)
{
  if (!CanBeTold(array) || static_cast<vtkIdType>(places.size()) >= array->GetNumberOfTuples())
  {
    TellRanges(array); // every tuple may be listed
    return;
  }
  switch (array->GetDataType())
  {
    vtkTemplateMacro(
      TellListed(array, static_cast<const VTK_TT*>(array->GetVoidPointer(0)), places));
    default:
      break;
  }
}

void TellRanges(vtkDataArray* array)
{
  if (!CanBeTold(array))
  {
    return;
  }
  switch (array->GetDataType())
  {
    vtkTemplateMacro(Tell(
      array, static_cast<const VTK_TT*>(array->GetVoidPointer(0)), array->GetNumberOfTuples()));
    default:
      break;
  }
}

void TellRangeOfAscending(vtkIdTypeArray* array)
{
  if (array->GetNumberOfTuples() > 0)
  {
    const std::array<vtkIdType, 2> ends = { array->GetValue(0),
      array->GetValue(array->GetNumberOfTuples() - 1) };
    Tell(array, ends.data(), 2);
  }
}

vtkSmartPointer<vtkPoints> MakePoints(vtkDataArray* places)
{
  const auto points = vtkSmartPointer<PointsOfRanges>::New();
  points->SetData(places);
  return points;
}

void TellRanges(vtkDataSet* data)
{
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(data->GetPointData()),
      static_cast<vtkDataSetAttributes*>(data->GetCellData()) })
  {
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      TellRanges(attributes->GetArray(i));
    }
  }
  auto* points = vtkPointSet::SafeDownCast(data);
  if (points && points->GetPoints())
  {
    TellRanges(points->GetPoints()->GetData());
  }
}

}
