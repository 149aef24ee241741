// title: Snell's law at the vertices
// alias: M1d
// citation: @misc{FakeRefraction2000,
//   title = {Approximating Refraction: Fake Refraction in DX7},
//   year = {2000},
//   note = {cube maps indexed by R = (1 - a)(N.E)N - E}
// }
// needs: interpolated
// at vertices: vertex_snell
// bends at equal index
// one way for all colours
// As one-interface, but bent at the vertices and interpolated: coarse triangles show.
// Beside the exact image it has the faults of one-interface; on fine meshes the two
// cannot be told apart.
