#include "tests/manual/bearing/roller_sections.h"
#include "tests/manual/bearing/roller_studies.h"

namespace mill::verify {
std::vector<Case> roller_cases()
{
  const std::string roller_in_space =
      "Roller 21.5 x 33.4 mm between raceways of radius 144.8 mm (convex) and 166.3 mm (concave), each held 12 mm "
      "behind its surface, E 206 GPa, nu 0.3, frictionless. An eighth of the roller and quarters of both raceways "
      "in "
      "triquadratic hexahedra, condensed for all parities, both contacts unilateral node by node, the roller free "
      "between them; 100 000 unknowns in the three bodies, 1400 nodes that may touch. ";
  std::vector<Case> cases;
  cases.push_back(
      {"fe-2d-flat", "verification",
       "Half of a roller of diameter 21.5 mm, cut at its diametral plane, on a flat raceway 12 and 25 mm thick, "
       "its "
       "back held and its sides free, four thicknesses away on each side; E 206 GPa, nu 0.3, plane strain, "
       "frictionless. The approach of the diametral plane and the back is imposed. Quadratic quadrilaterals on "
       "grids "
       "that do not match, condensed onto their patches, exact active set; 23 000 unknowns. Reported: a raceway "
       "of 20 "
       "mm to each side.",
       "Loads: a plane-strain series on quadratic triangles, which does not say how wide its raceway is and asks "
       "for "
       "four thicknesses at least. Half width: Hertz. Closed form: K. L. Johnson, Contact Mechanics (1985), 5.6, "
       "roller to its middle and raceway to its back. ISO/TS 16281: half of the approach of both contacts, roller "
       "length 33.4 mm",
       "1 % of the load, as asked for: the width is not recorded, and makes the thick raceway 0.9 % stiffer. "
       "Johnson's formula is that of a half plane read at the depth t, not of a strip held there: 2 to 3 %. Half "
       "width: 12 elements on it leave (h/b)^2/20, coarser on the smallest.",
       fe_2d_flat});
  cases.push_back(
      {"fe-2d-races", "verification",
       "As fe-2d-flat with the raceways of the demo bearing, 12 mm thick: convex of radius 144.8 mm, concave "
       "of radius 166.3 mm, backs concentric, sides at four thicknesses; 22 000 unknowns.",
       "As fe-2d-flat",
       "1 %: the width of the raceway and the shape of its back, flat or concentric, are not recorded.",
       fe_2d_races});
  cases.push_back(
      {"fe-mesh-order", "verification",
       "Roller on a flat raceway 12 mm thick as a slab one element thick between two smooth planes: the "
       "triquadratic "
       "hexahedra and the node-to-node contact of the roller in space, even elements of 1.6 to 0.125 half widths "
       "b "
       "across the contact. The error of the load is the root mean square over twelve approaches from 6 to 11 um, "
       "against h/b 0.05; up to 40 000 unknowns.",
       "Itself on the finest mesh, which is compared with the 291.4 N/mm at 8 um. Order: a contact "
       "whose edge "
       "falls anywhere in an element is known to a share of h, and the load changes with the square of it",
       "0.3 % at h/b 0.5 is asked for. The order is fitted over the whole series; single errors scatter by the "
       "place of "
       "the edge in its element, so 1.5 is asked of the expected 2.",
       fe_mesh_order});
  cases.push_back(
      {"fe-roller-3d", "verification", roller_in_space + "No crown, 10 kN.",
       "ISO/TS 16281, 813 048 N/mm^(10/9); Palmgren's law of both contacts, 5.415e5 N/mm; the plane sections of "
       "fe-2d-races under the mean line load",
       "A line contact has no deflection without a datum: rigid backs at 12 mm make it stiffer than the laws, "
       "which "
       "count rings of usual thickness. Against the plane sections 1 %: the ends carry more than the middle, but "
       "the "
       "mean over the roller hardly changes.",
       fe_roller_3d});
  cases.push_back({"roller-slice-law", "verification",
                   roller_in_space + "The law of the bearing's assembly, 41 slices with a flexibility matrix and "
                                     "one logarithm each, against both "
                                     "contacts solved node by node: loads of 1 to 100 kN, each at tilts of 0 to 2 "
                                     "mrad, without crown and with the "
                                     "ISO crown of tapered rollers.",
                   "Identity: the same condensed matrices, in one case with all nodes free to touch, in the other "
                   "with every slice "
                   "load spread as Hertz has it",
                   "The node-to-node contact is the coarser of the two: on half the element size both draw "
                   "together and the law "
                   "moves by 0.1 % only. At h/b 0.5 a node more or less is 0.2 % of the load (fe-mesh-order), at "
                   "both ends of a "
                   "crowned contact along the line as well. At 1 and 2 kN the contact is one element wide.",
                   roller_slice_law});
  cases.push_back({"roller-tilt", "verification",
                   roller_in_space +
                       "Exact 2 x 2 tangent of load and moment over approach and tilt, the roller's own place "
                       "eliminated, at 2 and 20 kN, tilts of 0, 0.4 and 1.5 mrad, with and without the ISO crown.",
                   "Identities: central differences between states of one set of touching nodes, symmetry of the "
                   "tangent, mirror "
                   "image, balance of the free roller",
                   "Within one set the problem is linear: only rounding remains. 1e-6 is asked for.",
                   roller_tilt});
  cases.push_back(
      {"roller-on-ring", "verification",
       "A cup of 24 mm held on its outside: meshed as such behind one roller, and as the law of the roller "
       "on a raceway of 12 mm with how far the ring deflects beyond it, sum of the harmonics of its meridian "
       "section. One element per half width of the finest load, 10 and 50 kN.",
       "Both in one model: contact elements with the thicker raceway, on the same mesh lines",
       "The two share the error of the contact mesh. What the ring adds is a tenth of the approach; its "
       "sides are free at four walls in one model and closed in the other, and what reaches the ring is "
       "described by three polynomials along the roller: a twentieth of a tenth.",
       roller_on_ring});
  cases.push_back(
      {"published-kzc", "benchmark",
       "Published stiffnesses of the demo bearing: four values printed as those of its rows, and a total. "
       "For comparison one roller by contact elements with the ISO crown, raceways on rigid backs; the assembled "
       "bearing stands in the report of its case.",
       "Preprint doi 10.21203/rs.3.rs-1441429/v1; the exponent of the third row is missing there",
       "The link is arithmetic: values of one roller in each row times Z/5, the load-distribution number of a "
       "bearing with clearance; the total is printed with three digits. It holds to 0.4 % and judges nothing of "
       "this program; the publication names no load, so nothing else can be judged either.",
       published_rollers});
  return cases;
}
}  // namespace mill::verify
