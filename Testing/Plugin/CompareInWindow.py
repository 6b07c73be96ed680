"""The menu NURBSTrim's Compare Correction Types: four views that turn together, made from a mesh
and a surface that are selected, and from a trim with its settings."""
from Window import Window

window = Window(size=(1400, 900))
window.open("sheet.vtu")
window.apply()
window.open("plane.igs")
window.apply()
window.select("0:0/0:0")
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface="0:0/1:0")
window.set_check("InvertSide", True)
window.apply()
window.action("CompareCorrectionTypes")
window.python("check_comparison(kept=12 * 24, volumes=(12 * 6, 11.7 * 6, 11.7 * 6))")
window.picture("window-comparison.png")
window.run("compare-in-window")
