// title: rays through a tree of boxes
// alias: R0f
// citation: @inproceedings{YlitieKarrasLaine2017,
//   author = {Henri Ylitie and Tero Karras and Samuli Laine},
//   title = {Efficient Incoherent Ray Traversal on {GPU}s Through Compressed Wide {BVH}s},
//   booktitle = {Proceedings of High Performance Graphics},
//   year = {2017}
// }
// needs: ray_path
// follows rays
// Follows the exact chain in 32 bits through the bodies' own triangles and formulas, total
// reflections, nested media and opaque surroundings included; with samples, all ways of the
// light by chance. Beside the exact image it is the same: without samples there are no
// highlights and no reflections but the total ones, with samples there is grain (at most eight
// per position: a driver that bounds loops loses the light of more), and after many events
// single pixels differ.
