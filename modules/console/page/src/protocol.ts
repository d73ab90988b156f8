// What station and page say to each other; the station's side is console_app.cpp.

export type Point = [number, number];

export interface Door {
  id: number; name: string;
  x_m: number; y_m: number; yaw_rad: number;
  width_m: number; depth_m: number;
}

export interface Plan {
  walls: Point[][];
  doors: Door[];
  cupboards: { id: number; name: string; corners: Point[] }[];
  no_go: { name: string; corners: Point[] }[];
}

export interface Hello {
  type: "hello";
  version: string;
  plan: Plan;
  body: { length_m: number; width_m: number };
  head?: { x_m: number; y_m: number; z_m: number };  // where pan and tilt axis meet, base frame
  link: { bytes_per_s: number };
  speed: Record<"slow" | "fast", { speed_m_s: number; turn_rad_s: number }>;
  channels: Record<string, { stale_after_s: number; on_request: boolean }>;
  replay?: { length_s?: number };  // without: somebody else plays the log
  video?: boolean;  // pictures of the third camera can be had
  any_bus?: boolean;  // no robot of PRIAMOS: everything that is on a bus, to be plotted
}

export interface StationState {
  role: "driver" | "viewer";
  seat: "free" | "yours" | "other";
  session: number;
  phase: "no_device" | "idle" | "must_let_go" | "asking" | "driving";
  mode: "base" | "head";
  fast: boolean;
  pages: number;
  refused: number;
  late: number;
  no_video?: string;  // why no pictures come although somebody looks
  replay?: ReplayState;
}

/** How far a log has been shown. */
export interface ReplayState { position_s: number; speed: number; paused: boolean }

export interface Item<T = Record<string, unknown>> {
  key: string;
  channel: string;
  type: string;
  age_s: number;
  message: T;
}

export interface News {
  type: "news";
  beat: number;
  station: StationState;
  items: Item[];
}

export interface StickReport {
  axis: number[];  // forward, left, up, roll, pitch, turn
  hold: boolean;
  rearm: boolean;
  take_over: boolean;
  mode: boolean;
  range: boolean;
}

// Messages of the bus, as far as the page reads them (lcmtypes/).

export interface Pose {
  x_m: number; y_m: number; yaw_rad: number;
  vx_m_s: number; vy_m_s: number; wz_rad_s: number;
  sigma_x_m: number; sigma_y_m: number; sigma_yaw_rad: number;
  rho_x_y: number;
}

/** A limit of DRIVE_STATUS: something is near. */
export const LIMIT_SONAR = 1;

export interface DriveStatus {
  mode: number; limit: number; remaining_m: number; speed_m_s: number;
  nearest_m: number; nearest_x_m: number; nearest_y_m: number;
  allowed: number; driver: number; session: number; estop: boolean; refused: number; refusal: number;
}

export interface MissionStatus {
  mission: number; phase: number; text: string; order_id: number; title: string; running: boolean; paused: boolean;
  step: number; n_steps: number; round: number; rounds: number; left_s: number;
  waiting: { order_id: number; title: string }[];
  results: { order_id: number; step: number; round: number; outcome: number; took_s: number; text: string }[];
}

export type ParameterAction = "read" | "set" | "save" | "reset";

export interface ParameterValue {
  process: number; outcome: number; table: number; key: number; value: number; next_changed: number; unsaved: boolean;
}

export interface PoseCorrection { request_id: number; verdict: number }

export interface Path { path_id: number; points: { x_m: number; y_m: number; yaw_rad: number }[] }

export interface LinkChannel {
  channel: string; outgoing: boolean; messages: number; bytes: number; dropped: number; expired: number;
  unwanted: number; late: number; queue_age_s: number;
}

export interface LinkStatus {
  up: boolean; alarm: boolean; table_mismatch: boolean; onboard: boolean;
  utilisation: number; utilisation_in: number;
  frames_rejected: number; dropped: number; resent: number;
  loss: number; peer_loss: number; latency_s: number; round_trip_s: number;
  channels: LinkChannel[];
}

export interface Health {
  process: string; state: number; text: string;
  messages_lost: number; decode_errors: number; handler_exceptions: number; loop_overruns: number;
  clock_ahead_s?: number; clock_uncertainty_s?: number;  // logs of before have neither
}

export interface AlarmAck { source: string; utime_alarm: number; by: string }

export type ProcessAction = "restart" | "log" | "new_world";

export interface ProcessState { process: string; state: number; starts: number; alarm: boolean }

export interface ProcessReport { request_id: number; name: string; outcome: number; begin_bytes: number; text: string }

export interface ScenarioOffer { name: string; title: string }

export interface Simulation { scenario: string; state: number; worlds: number; scenarios: ScenarioOffer[] }

export interface Alarm { utime: number; severity: number; source: string; text: string }

export interface LandmarkFix {
  landmark_id: number; side: number; verdict: number; n_matched: number; residual_px: number;
  x_m: number; y_m: number; yaw_rad: number;
}

export interface LookRequest { landmark_id: number; side: number }

export interface LandmarkModel {
  landmark_id: number; x_m: number; y_m: number; yaw_rad: number;
  edges: { x1_m: number; y1_m: number; z1_m: number; x2_m: number; y2_m: number; z2_m: number; side: number }[];
}

export interface FloorMap {
  revision: number; part: number; n_parts: number; cell_m: number; x_m: number; y_m: number;
  walls: { x1_m: number; y1_m: number; x2_m: number; y2_m: number }[];
  runs: { row: number; first: number; length: number }[];
  frontiers: { x_m: number; y_m: number; length_m: number; left: boolean }[];
}

export interface HeadState { pan_rad: number; tilt_rad: number; vergence_rad: number[]; zoom_step: number[]; focus_step: number[]; moving: boolean }

export interface DoorSeen { landmark_id: number; hinge: number; open_rad: number; sigma_rad: number }

/** A door that the head found in passing. */
export interface DoorFound { id: number; x_m: number; y_m: number; yaw_rad: number; width_m: number; state: number }

/** What the head put together from edges of space; kind: SCENE_EDGE, or a rectangle or box before which it stood. */
export interface SceneObject {
  id: number; kind: number; x_m: number; y_m: number; yaw_rad: number;
  width_m: number; depth_m: number; bottom_m: number; top_m: number; looks: number;
}
export const SCENE_EDGE = 0;

export interface SonarRanges { range_m: number[] }

export interface LandmarkView {
  camera: number;
  edges: { kind: number; u1_px: number; v1_px: number; u2_px: number; v2_px: number }[];
}

export interface ObstacleLine {
  verdict: number;
  segments: { kind: number; x1_m: number; y1_m: number; x2_m: number; y2_m: number }[];
}
