#include "CADModel.h"

#include "CADFile.h"
#include "CADFormat.h"
#include "CADOtherParts.h"
#include "CADProgress.h"
#include "IgesConics.h"
#include "IgesWeights.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Surface.hxx>
#include <IFSelect_ReturnStatus.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_BSplineSurface.hxx>
#include <IGESGeom_BoundedSurface.hxx>
#include <IGESGeom_TrimmedSurface.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_DocumentFile.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepGeom_Curve.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_GeometricSet.hxx>
#include <TColStd_MapOfTransient.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopTools_MapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <sstream>
#include <unordered_map>

namespace nurbs
{
namespace
{
/// By which a scale may differ from 1 as it is written.
constexpr double LargestScaleRounding = 1e-9;

/// Share of the progress that reading the file takes; the rest is transfer.
constexpr double ParsingShare = 0.3;

/// Takes OpenCASCADE's printers away while it lives.
class Silence
{
public:
  Silence()
  {
    this->Printers.Assign(Message::DefaultMessenger()->Printers());
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  ~Silence() { Message::DefaultMessenger()->ChangePrinters().Assign(this->Printers); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

private:
  Message_SequenceOfPrinters Printers;
};

std::string Trimmed(const Handle(TCollection_HAsciiString) & text)
{
  if (text.IsNull())
  {
    return std::string();
  }
  std::string name = text->ToCString();
  const size_t first = name.find_first_not_of(" \t\r\n");
  const size_t last = name.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? std::string() : name.substr(first, last - first + 1);
}

std::string IgesName(const Handle(IGESData_IGESEntity) & entity)
{
  if (entity.IsNull())
  {
    return std::string();
  }
  std::string name = entity->HasName() ? Trimmed(entity->NameValue()) : std::string();
  // A label without a subscript comes with "(0)" behind it.
  const size_t subscript = name.rfind("(0)");
  if (subscript != std::string::npos && subscript + 3 == name.size())
  {
    name.erase(subscript);
  }
  if (!name.empty())
  {
    return name;
  }
  // Some programs name the surface, not its trimmed form.
  if (auto trimmed = Handle(IGESGeom_TrimmedSurface)::DownCast(entity))
  {
    return IgesName(trimmed->Surface());
  }
  if (auto bounded = Handle(IGESGeom_BoundedSurface)::DownCast(entity))
  {
    return IgesName(bounded->Surface());
  }
  return std::string();
}

std::string StepName(const Handle(Standard_Transient) & entity)
{
  std::string name;
  if (auto item = Handle(StepRepr_RepresentationItem)::DownCast(entity))
  {
    name = Trimmed(item->Name());
  }
  else if (auto definition = Handle(StepBasic_ProductDefinition)::DownCast(entity))
  {
    if (!definition->Formation().IsNull() && !definition->Formation()->OfProduct().IsNull())
    {
      name = Trimmed(definition->Formation()->OfProduct()->Name());
    }
  }
  // What exporters write for want of a name.
  return name == "NONE" || name == "''" ? std::string() : name;
}

/// Is the entity one that alone, or always, is to give faces?
bool IsSurfaceEntity(const Handle(Standard_Transient) & entity, bool isRoot)
{
  if (auto iges = Handle(IGESData_IGESEntity)::DownCast(entity))
  {
    switch (iges->TypeNumber())
    {
      case 143:
      case 144:
        return true;
      case 108:
      case 114:
      case 118:
      case 120:
      case 122:
      case 128:
      case 140:
        return isRoot;
      default:
        return false;
    }
  }
  return !Handle(StepShape_FaceSurface)::DownCast(entity).IsNull();
}

/// Is the entity a curve of an IGES file that stands for itself?
bool IsCurveEntity(const Handle(Standard_Transient) & entity, bool isRoot)
{
  const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity);
  if (iges.IsNull() || !isRoot)
  {
    return false;
  }
  switch (iges->TypeNumber())
  {
    case 100:
    case 102:
    case 104:
    case 110:
    case 112:
    case 126:
    case 130:
      return true;
    case 106: // linear paths, not points, hatches or arrows
      return (iges->FormNumber() >= 11 && iges->FormNumber() <= 13) || iges->FormNumber() == 63;
    default:
      return false;
  }
}

bool Has(TopAbs_ShapeEnum type, const TopoDS_Shape& shape)
{
  return !shape.IsNull() && TopExp_Explorer(shape, type).More();
}

/// What the file says of a shape, whatever its location.
struct ShapeNote
{
  std::string Name;
  std::vector<double> Range;
  bool IsTrimmedSurface = false; ///< of IGES (type 144): one face with holes
  std::optional<bool> HasSense;  ///< of a face of STEP: its normal is the surface's
};
using NoteMap = std::unordered_map<const TopoDS_TShape*, ShapeNote>;

/**
 * The starting and ending parameters of a B-spline surface (type 128), alone or within a trimmed
 * one, which may be less than the range of its knots. OpenCASCADE does not look at them. An outer
 * contour has the last word: some programs let it bulge a little beyond that range.
 */
std::vector<double> IgesRange(Handle(IGESData_IGESEntity) entity)
{
  if (auto trimmed = Handle(IGESGeom_TrimmedSurface)::DownCast(entity))
  {
    entity = trimmed->HasOuterContour() ? nullptr : trimmed->Surface();
  }
  auto spline = Handle(IGESGeom_BSplineSurface)::DownCast(entity);
  if (spline.IsNull())
  {
    return std::vector<double>();
  }
  // The file has U(0), U(1), V(0), V(1). OpenCASCADE (7.6, and later) reads them in the order
  // UMin, VMin, UMax, VMax, so they come under each other's names.
  const double firstU = spline->UMin();
  const double lastU = spline->VMin();
  const double firstV = spline->UMax();
  const double lastV = spline->VMax();
  // Out of the knots' range, or empty: some programs write what they like here.
  const bool sound = firstU >= spline->KnotU(0) &&
    lastU <= spline->KnotU(spline->NbKnotsU() - 1 - 2 * spline->DegreeU()) &&
    firstV >= spline->KnotV(0) &&
    lastV <= spline->KnotV(spline->NbKnotsV() - 1 - 2 * spline->DegreeV()) && firstU < lastU &&
    firstV < lastV;
  return sound ? std::vector<double>{ firstU, lastU, firstV, lastV } : std::vector<double>();
}

NoteMap CollectNotes(const Handle(Transfer_TransientProcess) & process)
{
  NoteMap notes;
  // Products last: they are named only where the item itself is not.
  for (bool products : { false, true })
  {
    for (int i = 1; i <= process->NbMapped(); ++i)
    {
      const Handle(Standard_Transient) entity = process->Mapped(i);
      const TopoDS_Shape shape = TransferBRep::ShapeResult(process->MapItem(i));
      const bool isProduct = !Handle(StepBasic_ProductDefinition)::DownCast(entity).IsNull();
      if (shape.IsNull() || isProduct != products)
      {
        continue;
      }
      const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity);
      const std::string name = iges.IsNull() ? StepName(entity) : IgesName(iges);
      ShapeNote& known = notes[shape.TShape().get()];
      known.Name = known.Name.empty() ? name : known.Name;
      if (!iges.IsNull() && known.Range.empty())
      {
        known.Range = IgesRange(iges);
      }
      if (const auto face = Handle(StepShape_FaceSurface)::DownCast(entity))
      {
        known.HasSense = face->SameSense();
      }
      known.IsTrimmedSurface =
        known.IsTrimmedSurface || !Handle(IGESGeom_TrimmedSurface)::DownCast(entity).IsNull();
    }
  }
  return notes;
}

/// One face with the wires of all; none if they are not of one surface and alike. Where OpenCASCADE
/// does not see that the holes lie within the outer wire, as within the seam of a sphere, it makes
/// a face of each.
TopoDS_Shape JoinFaces(const TopoDS_Shape& faces)
{
  const BRep_Builder builder;
  TopoDS_Face joined;
  Handle(Geom_Surface) surface;
  TopLoc_Location location;
  for (TopExp_Explorer it(faces, TopAbs_FACE); it.More(); it.Next())
  {
    const TopoDS_Face face = TopoDS::Face(it.Current());
    TopLoc_Location own;
    const Handle(Geom_Surface) ownSurface = BRep_Tool::Surface(face, own);
    if (joined.IsNull())
    {
      surface = ownSurface;
      location = own;
      builder.MakeFace(joined, surface, location, BRep_Tool::Tolerance(face));
      joined.Orientation(face.Orientation());
    }
    if (ownSurface != surface || own != location || face.Orientation() != joined.Orientation())
    {
      return TopoDS_Shape();
    }
    for (TopExp_Explorer wire(face.Oriented(TopAbs_FORWARD), TopAbs_WIRE); wire.More(); wire.Next())
    {
      builder.Add(joined, wire.Current());
    }
  }
  return joined;
}

/// Puts what the file holds, each once, into a model.
class ShapeCollector
{
public:
  ShapeCollector(const NoteMap& notes, CADModel& model)
    : Notes(notes)
    , Model(model)
  {
  }

  /// @param owner the nearest named shape around it.
  /// @param body  the index of the body around it, or -1.
  /// @param shell the number of the shell around it, or -1.
  void Collect(const TopoDS_Shape& given, const std::string& owner = std::string(), int body = -1,
    int shell = -1)
  {
    auto found = this->Notes.find(given.TShape().get());
    const ShapeNote note = found == this->Notes.end() ? ShapeNote() : found->second;
    TopoDS_Shape shape = given;
    if (note.IsTrimmedSurface && given.ShapeType() != TopAbs_FACE)
    {
      const TopoDS_Shape joined = JoinFaces(given);
      shape = joined.IsNull() ? given : joined;
    }
    const std::string name = note.Name.empty() ? owner : note.Name;
    const TopAbs_ShapeEnum type = shape.ShapeType();
    if (type == TopAbs_FACE || type == TopAbs_EDGE || type == TopAbs_SOLID)
    {
      if (!this->Seen.Add(type == TopAbs_FACE ? given : shape))
      {
        return;
      }
    }
    if (type == TopAbs_FACE)
    {
      this->Model.Faces.push_back(
        CADFace{ shape, note.Name, owner, note.Range, body, shell, false, TopoDS_Shape() });
      return;
    }
    if (type == TopAbs_EDGE)
    {
      this->Model.Edges.push_back(CADEdge{ shape, name });
      return;
    }
    if (type == TopAbs_SOLID)
    {
      body = static_cast<int>(this->Model.Bodies.size());
      this->Model.Bodies.push_back(shape);
    }
    shell = type == TopAbs_SHELL ? this->Shells++ : shell;
    // TopoDS_Iterator puts the owner's location and orientation on what it owns.
    for (TopoDS_Iterator it(shape); it.More(); it.Next())
    {
      this->Collect(it.Value(), name, body, shell);
    }
  }

private:
  const NoteMap& Notes;
  CADModel& Model;
  TopTools_MapOfShape Seen;
  int Shells = 0;
};

/// Curves of a geometric set of a STEP file that gave no edge.
int CountLost(const Handle(StepShape_GeometricSet) & set, const TopoDS_Shape& shape)
{
  int curves = 0;
  for (int i = 1; i <= set->NbElements(); ++i)
  {
    curves += !set->ElementsValue(i).Curve().IsNull();
  }
  return std::max(0, curves - CountShapes(TopAbs_EDGE, shape));
}

void CountUntransferred(
  XSControl_Reader& reader, const Handle(Transfer_TransientProcess) & process, CADModel& model)
{
  TColStd_MapOfTransient roots;
  for (int i = 1; i <= reader.NbRootsForTransfer(); ++i)
  {
    roots.Add(reader.RootForTransfer(i));
  }
  const Handle(Interface_InterfaceModel) entities = reader.Model();
  for (int i = 1; i <= entities->NbEntities(); ++i)
  {
    const Handle(Standard_Transient) entity = entities->Value(i);
    const bool isRoot = roots.Contains(entity);
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, entity);
    model.Untransferred += IsSurfaceEntity(entity, isRoot) && !Has(TopAbs_FACE, shape);
    model.UntransferredCurves += IsCurveEntity(entity, isRoot) && !Has(TopAbs_EDGE, shape);
    const auto set = Handle(StepShape_GeometricSet)::DownCast(entity);
    model.UntransferredCurves += set.IsNull() ? 0 : CountLost(set, shape);
    const auto document = Handle(StepBasic_DocumentFile)::DownCast(entity);
    const std::string name = document.IsNull() ? std::string() : Trimmed(document->Id());
    if (!name.empty())
    {
      model.References.push_back(name);
    }
  }
}

void SetParameters()
{
  // Each translator makes its parameters known when it is initialised.
  IGESControl_Controller::Init();
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  // Splines are not to be broken where they are less than C1.
  Interface_Static::SetIVal("read.iges.bspline.continuity", 0);
}

/// OpenCASCADE begins at the products of a STEP file; where a program wrote none it begins at the
/// representations of shapes instead.
void ChooseRoots(const Handle(Interface_InterfaceModel) & entities)
{
  bool hasProducts = false;
  for (int i = 1; i <= entities->NbEntities() && !hasProducts; ++i)
  {
    hasProducts = entities->Value(i)->IsKind(STANDARD_TYPE(StepBasic_ProductDefinition));
  }
  Interface_Static::SetIVal("read.step.product.mode", hasProducts ? 1 : 0);
}

/// `error` comes without the file's name.
bool Transfer(const std::string& path, CADFormat format, CADModel& model, std::string& error,
  const std::function<bool(double)>& progress)
{
  // The translators keep their parameters and sessions in global variables.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  const Silence silence;
  SetParameters();

  IGESControl_Reader iges;
  STEPControl_Reader step;
  XSControl_Reader& reader =
    format == CADFormat::IGES ? static_cast<XSControl_Reader&>(iges) : step;
  const char* name = format == CADFormat::IGES ? "IGES" : "STEP";
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone)
  {
    error = std::string("begins like ") + name +
      " but its content cannot be read; export it again from the CAD program";
    return false;
  }
  ChooseRoots(reader.Model());
  StraightenIgesConics(reader.Model());
  if (const auto drawn = Handle(IGESData_IGESModel)::DownCast(reader.Model()))
  {
    model.DrawnScale = drawn->GlobalSection().Scale();
  }
  if (!progress(ParsingShare))
  {
    return false;
  }
  Handle(ProgressBridge) bridge = new ProgressBridge(progress, ParsingShare);
  reader.TransferRoots(bridge->Start());
  if (bridge->Stopped)
  {
    return false;
  }

  const Handle(Transfer_TransientProcess) process =
    reader.WS()->TransferReader()->TransientProcess();
  const NoteMap notes = CollectNotes(process);
  ShapeCollector collector(notes, model);
  for (int i = 1; i <= reader.NbShapes(); ++i)
  {
    collector.Collect(reader.Shape(i));
  }
  const auto senseOf = [&notes](const CADFace& face)
  {
    const auto found = notes.find(face.Shape.TShape().get());
    return found == notes.end() ? std::nullopt : found->second.HasSense;
  };
  MarkOtherParts(model, senseOf);
  CountUntransferred(reader, process, model);
  return true;
}
}

//------------------------------------------------------------------------------
int CountShapes(TopAbs_ShapeEnum type, const TopoDS_Shape& shape)
{
  int count = 0;
  for (TopExp_Explorer it(shape, type); it.More(); it.Next())
  {
    ++count;
  }
  return count;
}

//------------------------------------------------------------------------------
void TellScale(const std::string& path, const CADModel& model, std::string& remarks)
{
  if (std::abs(model.DrawnScale - 1.0) <= LargestScaleRounding || model.DrawnScale == 0.0)
  {
    return;
  }
  std::ostringstream text;
  text << "the file gives its model a scale of " << model.DrawnScale
       << ", and its coordinates are taken as they are: if the surface comes out in another size, "
          "export it at a scale of 1";
  AddRemark(path, text.str(), remarks);
}

//------------------------------------------------------------------------------
bool ReadCADModel(const std::string& path, CADModel& model, std::string& error,
  const std::function<bool(double)>& progress)
{
  const CADFormat format = CheckCADFile(path, error);
  if (format == CADFormat::None)
  {
    return false;
  }
  const std::string file = "CAD file \"" + path + "\"";
  const std::string weight = format == CADFormat::IGES ? FindBadIgesWeight(path) : std::string();
  if (!weight.empty())
  {
    error = file + ": " + weight + "; give every control point a positive weight";
    return false;
  }
  const bool success = Transfer(path, format, model, error, progress);
  error = error.empty() ? error : file + " " + error;
  return success;
}

//------------------------------------------------------------------------------
bool CatchFailures(const std::string& path, std::string& error, const std::function<bool()>& work)
{
  std::string reason;
  try
  {
    return work();
  }
  catch (const Standard_Failure& failure)
  {
    reason = std::string("OpenCASCADE reports ") + failure.DynamicType()->Name() + " " +
      failure.GetMessageString();
  }
  catch (const std::bad_alloc&)
  {
    reason = "it needs too much memory";
  }
  catch (const std::exception& failure)
  {
    reason = failure.what();
  }
  error = "CAD file \"" + path + "\" could not be read: " + reason +
    "; export it again from the CAD program";
  return false;
}

//------------------------------------------------------------------------------
std::string CatchReason(const std::function<std::string()>& work)
{
  try
  {
    return work();
  }
  catch (const Standard_Failure& failure)
  {
    return std::string("OpenCASCADE: ") + failure.DynamicType()->Name() + " " +
      failure.GetMessageString();
  }
  catch (const std::bad_alloc&)
  {
    return "it needs too much memory";
  }
  catch (const std::exception& failure)
  {
    return failure.what();
  }
}
}
