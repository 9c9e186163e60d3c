// The documents of the server, as far as the page reads them. Lengths are in mm about the scan's centre. Keys are those of
// `--json`; a key that the page does not know is left alone.

export type Vec3 = [number, number, number];

export interface Summary {
  id: string;
  name: string;
  stage: "cutting" | "cut" | "done";
  revision: string;
  undo: string | null;
  redo: string | null;
  writer: string | null;
}

export type WorkState = "queued" | "running" | "stopping" | "stopped" | "done" | "failed" | "lost";

export interface Work {
  id: string;
  kind: string;
  of: string | null;
  state: WorkState;
  what: string;
  done: number;
  total: number;
  elapsed_s: number;
  remaining_s: number | null;
  messages: string[];
  result: unknown;
  error: ErrorDocument | null;
}

export interface Cell {
  id: string;
  name: string;
  address: string;
  kind: "real" | "simulated" | "unknown";
  state: string; // of PackML
  asks?: boolean; // a person at the cell is asked for consent
  job: string | null;
  progress: number | null;
  elapsed_s: number | null;
  remaining_s: number | null;
  program_chunk: number | null; // where the program is
  program_line: number | null; // in the file of the chunk, from 1
  tool: number | null;
  read_ms_ago: number | null;
  link: "connected" | "lost" | "never";
}

export interface QueueEntry {
  id: string;
  project: string; // id
  cell: string; // id
  piece: string;
  part: number;
  job: string; // SHA-256 of its file
  state:
    | "waiting"
    | "sending"
    | "asks"
    | "carving"
    | "held"
    | "ended"
    | "not_started"
    | "unknown"
    | "removed"
    | "not_handed_over";
  why: string;
}

export interface Hello {
  server: string;
  version: string;
  page: string;
}

export interface State {
  event: string;
  read_only: boolean;
  dispatch: "none" | "simulated" | "real";
  simulator: boolean;
  folder: string;
  projects: Summary[];
  checks: string[];
  work: Work[];
  cells?: Cell[]; // of a server that hands jobs over
  queue?: QueueEntry[];
  paused?: boolean;
}

export interface Files {
  folder: string;
  scans: { id: string; name: string; bytes: number }[];
  projects: {
    id: string;
    name: string;
    stage?: string;
    cuts?: number;
    pieces?: number;
    scan?: string;
    problem?: string | null;
  }[];
}

export interface Choices {
  units: string[];
  presets: { name: string; sentence: string }[];
  cells: { name: string; sentence: string }[];
}

// A sentence of the engine: its key is for programs that have a control of their own for it.
export interface Remedy {
  text: string;
  key: string;
  values: Remedy[];
}

// What was done by a command to a cell.
export interface CommandDocument {
  action: string;
  end: string;
  why: string;
  to_do: string | null;
  state: string | null;
}

// The error of the command line, with the key of its remedy.
export interface ErrorDocument {
  error?: string;
  what?: string;
  unchanged?: string;
  to_do?: string;
  code?: string | number;
  id?: string;
  remedy?: string | Remedy | null;
}

export type Terms = Record<string, number>;

export interface PlaneDocument {
  k?: number;
  normal: Vec3;
  offset_mm: number;
  terms: Terms;
  sections_cross?: boolean;
}

export interface CutDocument extends PlaneDocument {
  number: number;
  piece: string;
  pieces: string[];
  fragments: number;
}

export interface Preview {
  piece: string;
  plane: PlaneDocument;
  sections_cross: boolean;
  loops: Vec3[][];
  length_mm: number;
  makes: { side: "above" | "below"; faces: number; volume_mm3: number; fragment: boolean }[];
  milled_pieces?: { pieces: MilledPiece[] };
}

export interface Segment {
  notes: string[];
  demand_met: boolean;
  undo: string | null;
  redo: string | null;
  ended_because: string | null;
  weights: Terms;
  cuts: CutDocument[];
  pieces: { name: string; cut: number; faces: number; volume_mm3: number; unreachable_all_directions?: number }[];
  fragments: number;
  discarded: { name: string; volume_mm3?: number }[];
  warnings: string[];
  proposal?: {
    piece: string;
    faces: number;
    rules_hold: boolean;
    candidates: number;
    max_judged_planes: number;
    planes: PlaneDocument[];
  };
  preview?: Preview;
}

export interface Reach {
  orientations: { tool_axis: Vec3; tilt_deg: number; gained_share: number; depth_mm: number }[];
  area_mm2: number;
  hidden_mm2: number;
  steep_mm2: number;
  holder_mm2: number;
  too_narrow_mm2: number;
  unreachable_share: number;
  rest_material_mm3?: number;
}

export interface Setup {
  base_number: number;
  base_cut: number | null;
  base_description: string;
  block: string | null;
  block_mm: Vec3 | null;
  undercut: number;
  workholding: unknown;
  reach: Reach | null;
  fits: boolean;
  sawn?: boolean;
  margins_mm?: Record<string, number>; // by the name of the condition; negative: so much is missing
}

// Of a plane that is tried by the setups of its pieces. The side is that of the plane's own normal.
export interface MilledPiece {
  name: string;
  side: "above" | "below";
  fits: boolean;
  setups: Setup[];
  areas_mm2: Record<string, number>;
}

export interface SetupDocument {
  pieces: {
    name: string;
    ordered: { base_number: number | null; max_directions: number | null; tools: number[] | null } | null;
    setups: Setup[];
  }[];
}

export interface VerifyDocument {
  all_positive: boolean;
  jobs: {
    piece: string;
    sha256: string;
    positive: boolean;
    findings: { kind: string; file: string; line: number; text: string }[];
    findings_left_out: number;
  }[];
}

export interface DrawnPiece {
  name: string;
  mesh: string; // its id
  deviation_mm: number;
}

export interface Project {
  id: string;
  name: string;
  revision: string;
  stage: Summary["stage"];
  undo: string | null;
  redo: string | null;
  cell: { name: string } | null;
  segment: Segment; // while work has the project: as it was read last
  drawn: DrawnPiece[]; // the pieces as the view shows them: after a decision those before it, until the new ones are there
  history?: string[]; // the decisions in force, oldest first
}

export interface PlannedJob {
  piece: string;
  part: number;
  parts: number;
  file: string; // "B.qjob"
  job: string; // SHA-256 of the file
  block_mm: Vec3;
  time_s: number;
  proven: boolean;
}

export interface JobsDocument {
  cell: string;
  jobs: PlannedJob[];
  refused: string[]; // why they may not be handed over; empty: they may
}

export interface Plan extends JobsDocument {
  plan: string;
  kind: "real" | "simulated";
  expires_s: number;
}

// A job replayed: coordinates of the setup, mm.
export interface Replay {
  piece: string;
  part: number;
  parts: number;
  job: string; // SHA-256 of its file
  positive: boolean; // the verdict of its proof
  cell_mm: number;
  stock_off_mm: number; // a face of a stage is so far from the foam that it shows at most
  time_s: number;
  removed_mm3: number;
  path: string; // id of the way of the tool
  sections: { file: string; tool: number; orientation: number; points: number }[]; // of the way, in its order
  tools: { number: number; name: string }[];
  tool_axes: Vec3[]; // by orientation
  stages: { mesh: string; points: number; seconds: number; removed_mm3: number }[];
  deviation: { mesh: string; classes: string } | null; // of the piece; null before the last part
}

export interface Inspect {
  file: string;
  format: string;
  warnings: string[];
  faces: number;
  vertices: number;
  units: string | null;
  units_in_file: string | null;
  size: Vec3;
  size_text: string | null;
  min: Vec3;
  max: Vec3;
  volume: number;
  verdict: string;
  reasons: string[];
  holes: { edges: number; length: number; centre: Vec3 }[];
  places?: { kind: string; points: Vec3[] }[]; // in the units of the file
  solid_count: number;
  largest_solids: { volume: number; faces: number; centre: Vec3 }[]; // the largest first, at most 100
  [key: string]: unknown;
}

export interface Check {
  check: string;
  inspect: Inspect;
  mesh?: string; // in the units of the file
}

// Result of the work that makes a project.
export interface MadeProject {
  project: string; // its id; empty: none was made
  segment: Pick<Segment, "notes" | "demand_met"> & { done: string | null };
}

// Of the journals of cells: what was handed over, the oldest first.
export interface JournalDocument {
  journals: {
    cell_id: number;
    simulated: boolean;
    endpoint: string;
    jobs: JournalJob[];
  }[];
}

export interface JournalJob {
  job_id: string;
  sha256: string; // of the job file
  file: string;
  part: number;
  parts: number;
  created_ms: number; // since 1970
  started_ms: number | null;
  ended_ms: number | null;
  state: "ended" | "open" | "not_started" | "unknown";
  result: string | null;
}

export interface RepairResult {
  repair: {
    verdict: string;
    faces_in: number;
    faces: number;
    steps: { step: string; count: number; description: string }[];
    hausdorff_distance?: { largest: number; unit: string } | null;
    warnings: string[];
  };
  before: string;
  after: string;
}
