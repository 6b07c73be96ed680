#include "vtkTrimSurfaceRepresentation.h"

#include "FadingEdges.h"
#include "vtkHexahedralSkinFilter.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkPVLODActor.h>
#include <vtkPVRenderView.h>
#include <vtkProcessModule.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>
#include <limits>

vtkStandardNewMacro(vtkTrimSurfaceRepresentation);

namespace
{
/// Is the camera here that which the picture is drawn with? To a server's it is passed on later.
bool HasOwnCamera()
{
  const auto type = vtkProcessModule::GetProcessType();
  auto* controller = vtkMultiProcessController::GetGlobalController();
  return (type == vtkProcessModule::PROCESS_CLIENT || type == vtkProcessModule::PROCESS_BATCH) &&
    (!controller || controller->GetNumberOfProcesses() <= 1);
}

/// How near, along the direction of view, the camera comes to anything within the bounds.
double NearestDepth(vtkCamera* camera, const double bounds[6])
{
  double nearest = std::numeric_limits<double>::max();
  for (int corner = 0; corner < 8; ++corner)
  {
    double offset[3];
    for (int i = 0; i < 3; ++i)
    {
      offset[i] = bounds[2 * i + (corner >> i & 1)] - camera->GetPosition()[i];
    }
    nearest = std::min(nearest, vtkMath::Dot(offset, camera->GetDirectionOfProjection()));
  }
  return nearest;
}

/// The most pixels that a unit of length can have on the screen; infinite if it is not known.
double LargestScale(vtkRenderer* renderer, const double bounds[6])
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const int* size = renderer->GetSize();
  const int* tiles = renderer->GetRenderWindow()->GetTileScale();
  const double height = static_cast<double>(size[1]) * tiles[1];
  if (camera->GetParallelProjection())
  {
    return 0.5 * height / camera->GetParallelScale();
  }
  const double depth = NearestDepth(camera, bounds);
  if (!(depth > 0.0) || camera->GetUseHorizontalViewAngle())
  {
    return std::numeric_limits<double>::infinity();
  }
  // At the edge of the picture what lies along the line of sight is stretched.
  const double half = std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
  const double stretch = std::hypot(1.0, half, half * size[0] / std::max(1, size[1]));
  return 0.5 * height * stretch / (half * depth);
}
}

//------------------------------------------------------------------------------
vtkTrimSurfaceRepresentation::vtkTrimSurfaceRepresentation()
{
  this->GeometryFilter->Delete();
  this->GeometryFilter = vtkHexahedralSkinFilter::New();
  this->GeometryFilter->AddObserver(vtkCommand::ProgressEvent, this,
    &vtkTrimSurfaceRepresentation::HandleGeometryRepresentationProgress);
  this->SetupDefaults();
}

//------------------------------------------------------------------------------
bool vtkTrimSurfaceRepresentation::HaveEdgesFaded()
{
  auto* view = vtkPVRenderView::SafeDownCast(this->GetView());
  const double longest =
    vtkHexahedralSkinFilter::SafeDownCast(this->GeometryFilter)->GetLongestEdge();
  if (!view || !HasOwnCamera() || !(longest > 0.0) || !this->Actor->GetMatrix()->IsIdentity() ||
    !this->UseShaderReplacements || this->ShaderReplacementsString != FadingEdges())
  {
    return false;
  }
  // A triangle's height is at most its middle side, and that at most the longest edge of the facet.
  return longest * LargestScale(view->GetRenderer(), this->VisibleDataBounds) < InvisibleEdges;
}

//------------------------------------------------------------------------------
void vtkTrimSurfaceRepresentation::UpdateColoringParameters()
{
  const int asked = this->Representation;
  if (asked == SURFACE_WITH_EDGES && this->HaveEdgesFaded())
  {
    this->Representation = SURFACE;
  }
  this->Superclass::UpdateColoringParameters();
  this->Representation = asked;
}
