#pragma once
#include <cstdlib>
namespace freshet::sisph {
inline double knob(const char* name, double otherwise) { const char* v = std::getenv(name); return v ? std::atof(v) : otherwise; }
inline const double k_thin = knob("THIN", 0.2), k_grad = knob("GRAD", 0.05), k_det = knob("DET", 1), k_vlo = knob("VLO", 0.1), k_vhi = knob("VHI", 0.3), k_head = knob("HEAD", 0.25);
}
