/**
 * @file TrimLineDrawing.h
 * @brief A trim line across the mesh that is selected, ready to be dragged.
 */
#ifndef TrimLineDrawing_h
#define TrimLineDrawing_h

#include "TrimSelection.h"

namespace TrimLineDrawing
{
/// The mesh that is to be trimmed next: the one selected, what a selected trim has left, or its
/// offcut, if that is selected.
SelectedOutput FindMesh();

/**
 * Makes a Trim Line Source with the mesh as its Sheet and five points in a straight line along the
 * longest extent of the mesh, on top of it and a little beyond both its ends; its widget is shown,
 * and Apply is left to the user. The trace has it as one line with sheet and points.
 */
void Start(const SelectedOutput& mesh);
}

#endif
