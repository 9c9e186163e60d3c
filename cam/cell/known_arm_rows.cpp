// Facts alone: what the named files state, which describe the arms joint by joint, in the lengths of known_arms.h.
// Joint ranges and speeds are those of the same file, rounded to what a data sheet prints, except where a row says that
// they are assumed: the file of KR 120 R2500 pro repeats those of a smaller arm, that of IRB 2600-12/1.65 swaps the
// ends of axis 2, and Fanuc's limit axes 2 and 3 together. Payloads follow from the names of the types; Staubli's are
// those of the brochures, at full speed, and assumed. O(1).

#include "cam/cell/known_arms.h"

namespace qchopper {
namespace {

// clang-format off
// id, name, maker, a1 to c4, height of the base, payload, least and greatest joints, speeds, whether ranges and payload
// are assumed, source
constexpr auto rows = std::to_array<KnownArm>({
    {"kr210-r2700", "KUKA KR 210 R2700 extra", Maker::kuka, {350, 41, 0, 675, 1150, 1200, 215}, 0, 210,
     {-185, -140, -120, -350, -125, -350}, {185, -5, 155, 350, 125, 350}, {123, 115, 112, 179, 172, 219},
     false, false, "ROS-Industrial kuka_experimental, kr210r2700extra_macro.xacro at 01ae9a4"},
    {"kr210-r3100-2", "KUKA KR 210 R3100-2", Maker::kuka, {330, -115, 0, 645, 1350, 1420, 240}, 0, 210,
     {-185, -140, -120, -350, -122.5, -350}, {185, -5, 168, 350, 122.5, 350}, {105, 94, 100, 136, 129, 206},
     false, false, "ROS-Industrial kuka_experimental, kr210_r3100-2_macro.xacro at e2e224e"},
    {"kr270-r2700", "KUKA KR 270 R2700 ultra", Maker::kuka, {350, 41, 0, 675, 1150, 1200, 240}, 0, 270,
     {-185, -140, -120, -350, -122.5, -350}, {185, -5, 150, 350, 122.5, 350}, {105, 101, 107, 122, 113, 175},
     false, false, "ROS-Industrial kuka_experimental, kr270r2700_macro.xacro at a8c937c"},
    {"kr340-r3330", "KUKA KR 340 R3330", Maker::kuka, {500, 55, 0, 1045, 1300, 1525, 290}, 0, 340,
     {-185, -130, -100, -350, -120, -350}, {185, 20, 144, 350, 120, 350}, {90, 80, 75, 90, 83, 130},
     false, false, "ROS-Industrial kuka_experimental, kr340r3330_macro.xacro at 400671b"},
    {"kr420-r3330", "KUKA KR 420 R3330", Maker::kuka, {500, 55, 0, 1045, 1300, 1525, 290}, 0, 420,
     {-185, -130, -100, -350, -120, -350}, {185, 20, 144, 350, 120, 350}, {80, 75, 70, 70, 70, 110},
     false, false, "ROS-Industrial kuka_experimental, kr420r3330_macro.xacro at 3d51096"},
    {"kr150-r3100-2", "KUKA KR 150 R3100-2", Maker::kuka, {330, -115, 0, 645, 1350, 1420, 215}, 0, 150,
     {-185, -140, -120, -350, -125, -350}, {185, -5, 168, 350, 125, 350}, {105, 107, 114, 190, 180, 260},
     false, false, "ROS-Industrial kuka_experimental, kr150r3100_2_macro.xacro at 920dc50"},
    {"kr120-r2500-pro", "KUKA KR 120 R2500 pro", Maker::kuka, {350, 41, 0, 675, 1150, 1000, 215}, 0, 120,
     {-185, -140, -120, -350, -125, -350}, {185, -5, 155, 350, 125, 350}, {136, 130, 120, 292, 258, 284},
     true, false, "ROS-Industrial kuka_experimental, kr120r2500pro_macro.xacro at 62c4af1"},
    {"kr60-ha", "KUKA KR 60 HA", Maker::kuka, {350, -145, 0, 815, 850, 820, 170}, 0, 60,
     {-185, -135, -120, -350, -119, -350}, {185, 35, 158, 350, 119, 350}, {128, 102, 128, 260, 245, 322},
     false, false, "ROS-Industrial kuka_experimental, kr60ha_macro.xacro at 095b62e"},
    {"kr70-r2100", "KUKA KR 70 R2100", Maker::kuka, {175, -50, 0, 575, 890, 1035, 185}, 0, 70,
     {-185, -175, -120, -180, -125, -350}, {185, 60, 165, 180, 125, 350}, {180, 158, 160, 230, 230, 320},
     false, false, "ROS-Industrial kuka_experimental, kr70_r2100_macro.xacro at 4998a09"},
    {"kr50-r2100", "KUKA KR 50 R2100", Maker::kuka, {175, -50, 0, 575, 890, 1035, 185}, 0, 50,
     {-185, -175, -120, -180, -125, -350}, {185, 60, 165, 180, 125, 350}, {180, 175, 175, 250, 250, 360},
     false, false, "ROS-Industrial kuka_experimental, kr50_r2100_macro.xacro at 8677ec6"},
    {"kr16-2", "KUKA KR 16-2", Maker::kuka, {260, 35, 0, 675, 680, 670, 158}, 0, 16,
     {-185, -155, -130, -350, -130, -350}, {185, 35, 154, 350, 130, 350}, {156, 156, 156, 330, 330, 615},
     false, false, "ROS-Industrial kuka_experimental, kr16_2_macro.xacro at 0849a26"},
    {"kr16-r2010-2", "KUKA KR 16 R2010-2", Maker::kuka, {160, -150, 0, 520, 980, 860, 153}, 0, 16,
     {-185, -185, -138, -350, -130, -350}, {185, 65, 175, 350, 130, 350}, {200, 175, 190, 430, 430, 630},
     false, false, "ROS-Industrial kuka_experimental, kr16_r2010_2_macro.xacro at bb2c6ee"},
    {"kr20-r1810-2", "KUKA KR 20 R1810-2", Maker::kuka, {160, -150, 0, 520, 780, 860, 153}, 0, 20,
     {-185, -185, -138, -350, -130, -350}, {185, 65, 175, 350, 130, 350}, {200, 175, 190, 430, 430, 630},
     false, false, "ROS-Industrial kuka_experimental, kr20_r1810_2_macro.xacro at 3137845"},
    {"kr22-r1610-2", "KUKA KR 22 R1610-2", Maker::kuka, {160, -150, 0, 520, 780, 655, 153}, 0, 22,
     {-185, -185, -138, -350, -130, -350}, {185, 65, 175, 350, 130, 350}, {200, 175, 190, 430, 430, 630},
     false, false, "ROS-Industrial kuka_experimental, kr22r1610_2_macro.xacro at d6e881c"},
    {"kr10-r1420", "KUKA KR 10 R1420", Maker::kuka, {150, -20, 0, 450, 610, 660, 80}, 0, 10,
     {-170, -185, -137, -185, -120, -350}, {170, 65, 163, 185, 120, 350}, {220, 210, 270, 381, 311, 492},
     false, false, "ROS-Industrial kuka_experimental, kr10r1420_macro.xacro at 9eb27bb"},
    {"kr10-r1100-2", "KUKA KR 10 R1100-2", Maker::kuka, {25, -25, 0, 400, 560, 515, 90}, 0, 10,
     {-170, -190, -120, -185, -120, -350}, {170, 45, 156, 185, 120, 350}, {300, 225, 330, 360, 360, 433},
     false, false, "ROS-Industrial kuka_experimental, kr10r1100_2_macro.xacro at a92386f"},
    {"irb6700-200-2.60", "ABB IRB 6700-200/2.60", Maker::abb, {320, -200, 0, 780, 1125, 1142.5, 200}, 0, 200,
     {-170, -65, -180, -300, -130, -360}, {170, 85, 70, 300, 130, 360}, {110, 110, 110, 190, 150, 210},
     false, false, "ROS-Industrial abb, irb6700_200_260_macro.xacro at 655ec59"},
    {"irb6700-235-2.65", "ABB IRB 6700-235/2.65", Maker::abb, {320, -200, 0, 780, 1135, 1182.5, 200}, 0, 235,
     {-170, -65, -180, -300, -130, -360}, {170, 85, 70, 300, 130, 360}, {100, 90, 90, 170, 120, 190},
     false, false, "ROS-Industrial abb, irb6700_235_265_macro.xacro at 3111b71"},
    {"irb6640-185-2.8", "ABB IRB 6640-185/2.8", Maker::abb, {320, -200, 0, 780, 1075, 1392, 200}, 0, 185,
     {-170, -65, -180, -300, -120, -360}, {170, 85, 70, 300, 120, 360}, {100, 90, 90, 170, 140, 190},
     false, false, "ROS-Industrial abb, irb6640_185_280_macro.xacro at d734892"},
    {"irb6650s-125-3.5", "ABB IRB 6650S-125/3.5", Maker::abb, {600, -200, 0, 630, 1280, 1592, 200}, 0, 125,
     {-180, -40, -180, -300, -120, -360}, {180, 160, 70, 300, 120, 360}, {110, 90, 90, 150, 120, 235},
     false, false, "ROS-Industrial abb, irb6650s_125_350_macro.xacro at 34e6fdd"},
    {"irb7600-150-3.5", "ABB IRB 7600-150/3.5", Maker::abb, {410, -165, 0, 780, 1075, 2012, 250}, 0, 150,
     {-180, -60, -180, -300, -100, -360}, {180, 85, 60, 300, 100, 360}, {100, 60, 60, 100, 100, 190},
     false, false, "ROS-Industrial abb, irb7600_150_350_macro.xacro at 253bc54"},
    {"irb4600-40-2.55", "ABB IRB 4600-40/2.55", Maker::abb, {175, -175, 0, 495, 1095, 1270, 135}, 0, 40,
     {-180, -90, -180, -400, -125, -400}, {180, 150, 75, 400, 120, 400}, {175, 175, 175, 250, 250, 360},
     false, false, "ROS-Industrial abb, irb4600_40_255_macro.xacro at 0707207"},
    {"irb4600-60-2.05", "ABB IRB 4600-60/2.05", Maker::abb, {175, -175, 0, 495, 900, 960, 135}, 0, 60,
     {-180, -90, -180, -400, -125, -400}, {180, 150, 75, 400, 120, 400}, {175, 175, 175, 250, 250, 360},
     false, false, "ROS-Industrial abb, irb4600_60_205_macro.xacro at 1acdf69"},
    {"irb4600-20-2.50", "ABB IRB 4600-20/2.50", Maker::abb, {175, -175, 0, 495, 1095, 1235, 85}, 0, 20,
     {-180, -90, -180, -400, -125, -400}, {180, 150, 75, 400, 120, 400}, {175, 175, 175, 360, 360, 500},
     false, false, "ROS-Industrial abb, irb4600_20_250_macro.xacro at 0b336ee"},
    {"irb2600-12-1.85", "ABB IRB 2600-12/1.85", Maker::abb, {150, -115, 0, 445, 900, 795, 85}, 0, 12,
     {-180, -95, -180, -400, -120, -400}, {180, 155, 75, 400, 120, 400}, {175, 175, 175, 360, 360, 500},
     false, false, "ROS-Industrial abb, irb2600_12_185_macro.xacro at 385308a"},
    {"irb2600-12-1.65", "ABB IRB 2600-12/1.65", Maker::abb, {150, -115, 0, 445, 700, 795, 85}, 0, 12,
     {-180, -95, -180, -400, -120, -400}, {180, 155, 75, 400, 120, 400}, {175, 175, 175, 360, 360, 500},
     true, false, "ROS-Industrial abb, irb2600_12_165_macro.xacro at 566bf7e"},
    {"irb1600-10-1.45", "ABB IRB 1600-10/1.45", Maker::abb, {150, 0, 0, 486.5, 700, 600, 65}, 0, 10,
     {-180, -90, -245, -200, -115, -400}, {180, 120, 65, 200, 115, 400}, {180, 180, 185, 385, 400, 460},
     false, false, "ROS-Industrial abb, irb1600_10_145_macro.xacro at 09a4fee"},
    {"irb1200-5-0.9", "ABB IRB 1200-5/0.9", Maker::abb, {0, -42, 0, 399.1, 448, 451, 82}, 0, 5,
     {-170, -100, -200, -270, -130, -360}, {170, 130, 70, 270, 130, 360}, {288, 240, 300, 400, 405, 600},
     false, false, "ROS-Industrial abb, irb1200_5_90_macro.xacro at 30e6c44"},
    {"r2000ic-165f", "Fanuc R-2000iC/165F", Maker::fanuc, {312, -225, 0, 0, 1075, 1280, 215}, 670, 165,
     {-185, -60, -132, -360, -125, -360}, {185, 76, 180, 360, 125, 360}, {130, 115, 125, 180, 180, 260},
     true, false, "ROS-Industrial fanuc, r2000ic165f_macro.xacro at 12dce70"},
    {"r2000ic-210f", "Fanuc R-2000iC/210F", Maker::fanuc, {312, -225, 0, 0, 1075, 1280, 215}, 670, 210,
     {-185, -60, -132, -360, -125, -360}, {185, 76, 180, 360, 125, 360}, {120, 105, 110, 140, 140, 220},
     true, false, "ROS-Industrial fanuc, r2000ic210f_macro.xacro at 0d7b4d0"},
    {"m710ic-50", "Fanuc M-710iC/50", Maker::fanuc, {150, -170, 0, 0, 870, 1016, 175}, 565, 50,
     {-180, -90, -160, -360, -125, -360}, {180, 135, 280, 360, 125, 360}, {175, 175, 175, 250, 250, 355},
     true, false, "ROS-Industrial fanuc, m710ic50_macro.xacro at 008079e"},
    {"m20ia", "Fanuc M-20iA", Maker::fanuc, {150, -250, 0, 0, 790, 835, 100}, 525, 20,
     {-170, -100, -185, -200, -140, -270}, {170, 160, 273.1, 200, 140, 270}, {195, 175, 180, 360, 360, 550},
     true, false, "ROS-Industrial fanuc, m20ia_macro.xacro at 526347a"},
    {"rx160", "Staubli RX160", Maker::staubli, {150, 0, 0, 0, 825, 625, 110}, 550, 20,
     {-160, -137.5, -150, -270, -105, -270}, {160, 137.5, 150, 270, 120, 270}, {200, 200, 255, 315, 360, 870},
     false, true, "ROS-Industrial staubli, rx160_macro.xacro at 5c9e0a8"},
    {"rx160l", "Staubli RX160L", Maker::staubli, {150, 0, 0, 0, 825, 925, 110}, 550, 14,
     {-160, -137.5, -150, -270, -105, -270}, {160, 137.5, 150, 270, 120, 270}, {200, 200, 255, 315, 360, 870},
     false, true, "ROS-Industrial staubli, rx160l_macro.xacro at 43b1479"},
    {"tx90", "Staubli TX90", Maker::staubli, {50, 0, 50, 0, 425, 425, 100}, 478, 6,
     {-180, -130, -145, -270, -115, -270}, {180, 147.5, 145, 270, 140, 270}, {400, 400, 430, 540, 475, 760},
     false, true, "ROS-Industrial staubli_experimental, tx90_macro.xacro at 079b04a"}
});
// clang-format on

}  // namespace

std::span<const KnownArm> known_arms() {
    return rows;
}

}  // namespace qchopper
