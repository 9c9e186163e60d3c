// The joints are found again, the jobs are read one at a time; what costs time is the pictures.

#include "app/guide/write_guide.h"

#include "app/engine/export_pieces.h"
#include "app/guide/guide_html.h"
#include "app/guide/guide_pdf.h"
#include "app/guide/make_guide.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/printable.h"
#include "base/text.h"
#include "base/timings.h"
#include "cam/job/glue_faces.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// Those of the jobs; setups of pieces without a job are chosen.
std::vector<JointFaces> faces_of(const ProjectJoints& joints, const OrderContent& jobs,
                                 const std::vector<Piece>& pieces, Setups& setups) {
    const auto setup_of = [&](std::size_t piece) -> const Setup& {
        const auto known = jobs.setups.find(pieces[piece].name);
        return known != jobs.setups.end() ? known->second : setups.placed(pieces[piece]).setup();
    };
    std::vector<JointFaces> faces;
    for (const PieceJoint& joint : joints.joints) {
        faces.push_back(joint_faces(joint, setup_of(joint.below), setup_of(joint.above)));
    }
    return faces;
}

void write_animation(OpenProject& project, const fs::path& file, const std::string& program_version,
                     const Context& context) {
    ExportRequest request;
    request.format = "glb";
    request.out = file;
    std::error_code error;  // one that stays is refused by export_pieces
    fs::remove(file, error);
    export_pieces(project, request, program_version, context);
}

}  // namespace

WrittenGuide write_guide(OpenProject& project, const std::string& program_version, const Context& context) {
    const fs::path& folder = project.folder();
    if (project.project().stage != Stage::done) {
        throw InputError(InputFault::use, folder.string() + " has no jobs yet, and so no guide to its assembly",
                         "prepare it first: qchopper prepare " + shell_word(folder));
    }
    const Segmentation& segmentation = project.segmentation();
    project.check_cell();
    Setups& setups = *project.setups();
    ProjectJoints joints = project_joints(segmentation, &setups.cell(), context);
    StageTimer stage(context, "jobs read");
    const OrderContent jobs = order_content(folder, project.project(), segmentation, setups, joints.joints);
    joints.faces = faces_of(joints, jobs, segmentation.pieces, setups);
    const std::string order = project.project().scan.path.filename().string();
    stage.next("guide laid out");
    const AssemblyGuide guide = make_guide({order, segmentation.pieces, joints, jobs}, context);
    const std::string html = guide_html(guide);
    const Bytes pdf = guide_pdf(guide);
    context.check_cancelled();
    stage.next("guide written");
    write_file(folder / "guide.html", html);
    write_file(folder / "guide.pdf", pdf);
    write_animation(project, folder / "guide.glb", program_version, context);
    WrittenGuide written{std::move(joints), {}, {}};
    for (const char* name : {"guide.html", "guide.pdf", "guide.glb"}) written.files.push_back(folder / name);
    for (const AssemblyStep& step : written.joints.assembly.steps) {
        if (!must_be_held(step)) continue;
        for (const std::size_t p : step.moved) written.held.push_back(written.joints.pieces[p]);
    }
    return written;
}

std::vector<std::string> lines(const WrittenGuide& guide) {
    const ProjectJoints& joints = guide.joints;
    std::vector<std::string> text{counted(joints.pieces.size(), "piece") + ", " +
                                  counted(joints.joints.size(), "joint") + ", " +
                                  counted(joints.assembly.steps.size(), "step") + "."};
    for (const fs::path& file : guide.files) text.push_back(file.string());
    if (!guide.held.empty()) {
        text.push_back("To be held, for no glued face holds them at first: " + list_of_pieces(guide.held) + ".");
    }
    return text;
}

}  // namespace qchopper
