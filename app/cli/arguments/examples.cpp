// One table of texts.

#include "app/cli/arguments/examples.h"

#include <array>

namespace qchopper {
namespace {

struct Examples {
    const char* command;
    const char* lines;
};

constexpr std::array<Examples, 23> all_examples{{
    {"", R"(  qchopper sample vertebra --faces 50000 -o vertebra.ply
  qchopper inspect vertebra.ply --units mm
  qchopper prepare vertebra.ply --units mm --cell cells/foam-1.toml -o vertebra.qch
  qchopper dry-run vertebra.qch
  qchopper dispatch vertebra.qch --to 127.0.0.1:15020 --drop drop
Each command has more: qchopper COMMAND --help

Lengths are millimetres. Exit codes: 0 done, 1 a demand is not met, 64 wrong use, 65 the scan is wrong,
66 input missing, 69 cell not reachable, 73/74 cannot write, 75 try again later, 76 protocol, 78 settings file,
130 stopped (finished work is kept).)"},
    {"sample", R"(  qchopper sample vertebra --faces 50000 -o vertebra.ply
  qchopper sample femur --holes 3 --pen-grooves 2 -o femur.stl)"},
    {"fuse", R"(  qchopper fuse bun.conf -o bunny.ply
  qchopper fuse skull.conf --voxel 0.5 -o skull.ply)"},
    {"inspect", R"(  qchopper inspect vertebra.ply --units mm
  qchopper inspect femur.glb --deep
  qchopper inspect - --units mm --json < skull.stl.gz)"},
    {"repair", R"(  qchopper repair vertebra.ply --units mm -o solid.ply
  qchopper repair femur.obj --units cm --snap-borders 0.05 --fill fair --smooth-pen-grooves -o solid.ply)"},
    {"prepare", R"(  qchopper prepare vertebra.ply --units mm --cell cells/foam-1.toml -o vertebra.qch
  qchopper prepare femur.3mf --cell cells/foam-1.toml --preset femur --beam 3 -o femur.qch
  qchopper prepare femur.qch
  qchopper prepare vertebra.ply --units mm --cell cells/kr60-ha.toml --no-programs -o pieces-only.qch)"},
    {"segment", R"(  qchopper segment vertebra.ply --units mm -o by-hand.qch
  qchopper segment by-hand.qch --step
  qchopper segment by-hand.qch --accept 1
  qchopper segment by-hand.qch --plane 0,0,1,12.5 --piece B --write-pieces
  qchopper segment by-hand.qch --discard C,below=50ml
  qchopper segment by-hand.qch --undo
  qchopper segment by-hand.qch --cell cells/foam-1.toml
  qchopper segment by-hand.qch --auto --max-faces 20000
  qchopper segment by-hand.qch --plan vertebra.plan.toml
  qchopper segment fine.ply --units mm --replay vertebra.plan.toml -o fine.qch)"},
    {"explain", R"(  qchopper explain vertebra.qch
  qchopper explain vertebra.qch --cut 1 -o cut-1.svg)"},
    {"guide", R"(  qchopper guide vertebra.qch)"},
    {"export", R"(  qchopper export vertebra.qch --format 3mf
  qchopper export vertebra.qch --format stl --pose setup --simplify 0.05 -o models)"},
    {"cells", R"(  qchopper cells new --robot kr210-r2700
  qchopper cells list
  qchopper cells show cells/kr60-ha.toml -o reach.png
  qchopper cells check cells/kr60-ha.toml --json
  qchopper cells reach cells/kr60-ha.toml --tilt 30 --block 300,300,200)"},
    {"serve", R"(  qchopper serve scans --open
  qchopper serve skull.qch --cell-sim
  qchopper serve scans --dispatch real --key-file ~/.qchopper-key)"},
    {"setup", R"(  qchopper setup vertebra.qch
  qchopper setup vertebra.qch --piece B
  qchopper setup vertebra.qch --piece B --base 2 --orientations 3)"},
    {"work", R"(  qchopper prepare vertebra.ply --units mm --cell cells/kr60-ha.toml --items -o vertebra.qch
  qchopper work vertebra.qch --shard 0/2 &
  qchopper work vertebra.qch --shard 1/2 && wait
  qchopper gather vertebra.qch)"},
    {"submit", R"(  qchopper submit vertebra.qch
  qchopper submit vertebra.qch --shards 4 -- --partition=fast --account=bones
  qchopper submit vertebra.qch --print
  qchopper submit vertebra.qch --engine local --memory 8000
  qchopper submit vertebra.qch --retry)"},
    {"gather", R"(  qchopper work vertebra.qch --status
  qchopper gather vertebra.qch
  qchopper gather vertebra.qch --make-missing)"},
    {"verify", R"(  qchopper verify vertebra.qch
  qchopper verify vertebra.qch --piece B
  qchopper verify B.qjob --cell cells/kr60-ha.toml
  qchopper verify vertebra.qch/jobs/B.qjob --base 1012.5,-3.2,361.8,0.4,0,0 --tool 1=200.6 --tool 4=149.7)"},
    {"keys", R"(  qchopper keys make anna
  qchopper keys show
  qchopper keys trust anna.pub --name "Anna, office 2" --keys cell-keys.json
  qchopper keys revoke anna
  qchopper keys sign vertebra.qch --key anna
  qchopper keys check vertebra.qch/jobs/A.qjob)"},
    {"dry-run", R"(  qchopper dry-run vertebra.qch
  qchopper dry-run vertebra.qch --piece B)"},
    {"cell-sim", R"(  qchopper cell-sim --listen 127.0.0.1:15020 --drop drop --consent ask
  qchopper cell-sim --drop drop --script night.txt --store cell
  qchopper cell-sim --list-faults)"},
    {"dispatch", R"(  qchopper dispatch vertebra.qch --to 127.0.0.1:15020 --drop drop
  qchopper dispatch vertebra.qch --piece B
  qchopper dispatch vertebra.qch --piece B --from-chunk 12
  qchopper dispatch vertebra.qch --to 127.0.0.1:15020 --chunks --rehearse
  qchopper dispatch vertebra.qch --key anna)"},
    {"journal", R"(  qchopper journal show
  qchopper journal show cell-7 --json
  qchopper journal verify
  qchopper journal jobs --since 2026-11-22
  qchopper journal jobs cell-7 archive/cell-7-until-2026 --csv
  qchopper journal export cell-7 --before 2026-01-01 -o archive/cell-7-until-2026)"},
    {"cell", R"(  qchopper cell status --to 127.0.0.1:15020
  qchopper cell hold --to 127.0.0.1:15020
  qchopper cell check 192.168.7.20:502
  qchopper cell stop --cell cells/kr60-ha.toml
  qchopper cell take-over --to 127.0.0.1:15020 --code 4711
  qchopper cell accept-store --to 127.0.0.1:15020)"},
}};

}  // namespace

std::string examples_of(const std::string& command) {
    for (const Examples& e : all_examples) {
        if (command == e.command) return std::string("Examples:\n") + e.lines;
    }
    return {};
}

}  // namespace qchopper
