// The particle fields of semi-implicit SPH for the shallow water equations.
#pragma once
#include "cellgrid/particles/fields.hpp"

namespace freshet::sisph {

template <int D>
struct WaterFields {
  VecField<double, D> x, v, before;  // before: v^{n-1}, empty where no path needs it
  Field<double> depth, mass, bed;    // bed: empty where it is flat
  Field<double> h;                   // smoothing length, that of all
  Field<int> id, kind;               // kind > 0: beside the domain

  void declare(const FieldList& field) {
    field(x, "x", "y", "m", Carry::state);
    field(v, "u", "v", "m/s", Carry::state);
    field(depth, "depth", "m", Carry::state);
    field(h, "h", "m", Carry::state);
    field(mass, "mass", D == 1 ? "m2" : "m3", Carry::state);
    field(id, "id", "1", Carry::state);
    field(kind, "kind", "1", Carry::state);
  }
  void declare_bed(const FieldList& field) { field(bed, "bed", "m", Carry::state); }
  void declare_before(const FieldList& field) { field(before, "u_before", "v_before", "m/s", Carry::state); }
};

}  // namespace freshet::sisph
