# The stages of the paper's Fig. 8, from classify to write, as one static library.
add_library(NURBSTrimStages STATIC
  Mesh/Band.cxx
  Mesh/BandCells.cxx
  Mesh/BandPlace.cxx
  Mesh/Columns.cxx
  Mesh/ElementChain.cxx
  Mesh/ElementMap.cxx
  Mesh/FreshArray.cxx
  Mesh/GatherAttributes.cxx
  Mesh/HexMesh.cxx
  Mesh/Jacobian.cxx
  Mesh/LocalThickness.cxx
  Mesh/MeshBlocks.cxx
  Ranks/ControllerRanks.cxx
  Ranks/GatherBand.cxx
  Ranks/GhostCells.cxx
  Ranks/SharedBounds.cxx
  Ranks/SharedNodes.cxx
  Ranks/SharedSurface.cxx
  Classify/EdgeCrossing.cxx
  Classify/EndInside.cxx
  Classify/NodeClassification.cxx
  Classify/PieceSides.cxx
  Decide/Decision.cxx
  Decide/CutEdges.cxx
  Decide/EliminatedFraction.cxx
  Decide/Manifold.cxx
  Correct/Facet.cxx
  Correct/Moves.cxx
  Correct/NodeConstraint.cxx
  Correct/NodeMover.cxx
  Correct/NodeRelaxing.cxx
  Correct/SkinRing.cxx
  Treat/BandQuality.cxx
  Treat/BothParts.cxx
  Treat/CoincidentNodes.cxx
  Treat/ColumnChoices.cxx
  Treat/CreaseNodes.cxx
  Treat/DirectionBehind.cxx
  Treat/ElementWorth.cxx
  Treat/FailedReturns.cxx
  Treat/FloorClimb.cxx
  Treat/GuardedMesh.cxx
  Treat/InsertedLayer.cxx
  Treat/JointRelaxation.cxx
  Treat/LayerRelaxation.cxx
  Treat/LayerSkin.cxx
  Treat/LeastSquaresStep.cxx
  Treat/Offcut.cxx
  Treat/Pentahedra.cxx
  Treat/Relaxation.cxx
  Treat/RelaxedMesh.cxx
  Treat/ReturnedNodes.cxx
  Treat/TrimmedBand.cxx
  Treat/StepDirections.cxx
  Treat/TrialTrim.cxx
  Treat/ValidityLadder.cxx
  Renumber/NodeOrdering.cxx
  Renumber/PillarGraph.cxx
  Renumber/PillarOrdering.cxx
  Renumber/Pillars.cxx
  Renumber/RowSort.cxx
  Write/ArrayRanges.cxx
  Write/FindingArrays.cxx
  Write/GridPart.cxx
  Write/MapValues.cxx
  Write/NameClashes.cxx
  Write/OffcutGrid.cxx
  Write/PartQuality.cxx
  Write/StatusArrays.cxx
  Write/Summary.cxx
  Write/TrimmedGrid.cxx
  Write/ValueWeights.cxx
  Trim/BandTrim.cxx
  Trim/FeasibilityCheck.cxx
  Trim/InputScale.cxx
  Trim/LayerTrim.cxx
  Trim/Shortfalls.cxx
  Trim/TrimPipeline.cxx
  Trim/TrimWarnings.cxx)
foreach (stage IN ITEMS Mesh Ranks Classify Decide Correct Treat Result Renumber Write Trim)
  target_include_directories(NURBSTrimStages PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}/${stage}")
endforeach ()
target_link_libraries(NURBSTrimStages
  PUBLIC NURBSTrimGeometry Eigen3::Eigen VTK::CommonCore VTK::CommonDataModel
  PRIVATE Boost::headers VTK::ParallelCore)
target_compile_features(NURBSTrimStages PUBLIC cxx_std_17)
