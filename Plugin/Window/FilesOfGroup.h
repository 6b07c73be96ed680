/**
 * @file FilesOfGroup.h
 * @brief CAD files whose names differ in a number, which ParaView's dialog offers as one.
 */
#ifndef FilesOfGroup_h
#define FilesOfGroup_h

#include <QStringList>

class pqPipelineSource;

/// Warns if more files were chosen than a new reader of CAD files takes: ParaView gives it the
/// first one and says nothing of the others.
void WarnOfOtherFiles(pqPipelineSource* source, const QStringList& files);

#endif
