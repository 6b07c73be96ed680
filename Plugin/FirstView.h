/**
 * @file FirstView.h
 * @brief How trimming surfaces and the outputs of Trim Hexahedral Grid look when they are first
 * shown.
 */
#ifndef FirstView_h
#define FirstView_h

/**
 * From now on, an output of Trim Hexahedral Grid that is first shown in a render view is coloured
 * by ElementStatus, whichever array of the input is active, and the edges of its elements fade
 * where an element is only a few pixels wide, so that they do not hide the colours of a fine mesh.
 * Trimming surfaces are red, as the mesh is not. Whatever is set afterwards wins, and what a state
 * file holds is left as it is. Works in every client, with a window or without; called when the
 * plugin is loaded.
 */
void RegisterFirstView();

#endif
