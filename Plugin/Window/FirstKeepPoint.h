/**
 * @file FirstKeepPoint.h
 * @brief Where the keep point of a new trim is.
 */
#ifndef FirstKeepPoint_h
#define FirstKeepPoint_h

class pqPipelineSource;

/**
 * Puts the keep point of a trim that was made by the menu into the middle of the mesh, so that it
 * is in view, and can be dragged, when it is switched on. Scripts have to give one: theirs is (0,
 * 0, 0) at first.
 */
void SetFirstKeepPoint(pqPipelineSource* filter);

#endif
