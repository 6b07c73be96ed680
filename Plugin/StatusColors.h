/**
 * @file StatusColors.h
 * @brief Colours and names for the status arrays, known to ParaView from the plugin's load on.
 */
#ifndef StatusColors_h
#define StatusColors_h

/**
 * Gives the arrays of statuses and findings (NodeStatus, Feasibility, ...) default color maps in
 * which each value has a colour and a name of its own, so that the legend reads "keep" and
 * "eliminate" instead of numbers. The user's own defaults for these arrays win over them. Works in
 * every client, with a window or without; called when the plugin is loaded.
 */
void RegisterStatusColors();

#endif
