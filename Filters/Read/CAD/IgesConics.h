/**
 * @file IgesConics.h
 * @brief Puts the conic arcs (type 104) of an IGES file into a form that OpenCASCADE reads rightly.
 */
#ifndef IgesConics_h
#define IgesConics_h

#include <Standard_Handle.hxx>

class Interface_InterfaceModel;

namespace nurbs
{
/**
 * Replaces the coefficients of every conic arc in space by those in its own principal axes, with a
 * matrix of its own that turns it back: the same curve. OpenCASCADE (7.6, and later) exchanges the
 * axes of ellipses that are longer along y, and gives parabolas the wrong direction, unless they
 * come in this position. To be called between reading a file and transferring it; models of STEP
 * files are left alone, and so are curves in the parameters of a surface.
 */
void StraightenIgesConics(const opencascade::handle<Interface_InterfaceModel>& model);
}

#endif
