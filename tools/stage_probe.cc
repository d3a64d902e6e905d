// A controller for Stage 4.3: drives a robot, and writes down where it is and what it senses.
//
//   ctrl "stage_probe roam"             goes about blindly, backs off where it stalls
//   ctrl "stage_probe drive X Y TURN"   keeps a command [m/s, m/s, rad/s]; a car's are its speed,
//                                       nothing, and its steering angle [rad]
//
// With STAGE_PROBE=FILE in the environment "drive" writes a line a fact to that file: poses after
// every step, what is sensed once, after five. Built by benchmarks/_stage_itself.py.

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "stage.hh"

namespace {

const int LOOK = 5; // steps after which sensors are read

struct Probe {
  Stg::ModelPosition *robot;
  std::vector<Stg::Model *> devices;
  FILE *out;
  int steps, back, left;
};

void collect(Stg::Model *model, std::vector<Stg::Model *> &found)
{
  for (Stg::Model *child : model->GetChildren()) {
    found.push_back(child);
    collect(child, found);
  }
}

// What follows in a line: the kind of fact, the robot, and the device's place among the devices.
void begin(const Probe &probe, const char *kind, size_t device)
{
  fprintf(probe.out, "%s %s %zu", kind, probe.robot->Token(), device);
}

void write_pose(const Probe &probe)
{
  const Stg::Pose at = probe.robot->GetGlobalPose(), &guess = probe.robot->est_pose;
  fprintf(probe.out, "pose %s %d %.9f %.9f %.9f %d %.9f %.9f %.9f\n", probe.robot->Token(),
          probe.steps, at.x, at.y, at.a, int(probe.robot->Stalled()), guess.x, guess.y, guess.a);
}

void write_senses(const Probe &probe)
{
  for (size_t i = 0; i < probe.devices.size(); ++i) {
    Stg::Model *device = probe.devices[i];
    if (Stg::ModelRanger *ranger = dynamic_cast<Stg::ModelRanger *>(device)) {
      for (const Stg::ModelRanger::Sensor &sensor : ranger->GetSensors()) {
        begin(probe, "ranges", i);
        for (double range : sensor.ranges)
          fprintf(probe.out, " %.9f", range);
        begin(probe, "\nreturns", i);
        for (double seen : sensor.intensities)
          fprintf(probe.out, " %.9f", seen);
        fputc('\n', probe.out);
      }
    } else if (Stg::ModelFiducial *finder = dynamic_cast<Stg::ModelFiducial *>(device)) {
      for (const Stg::ModelFiducial::Fiducial &seen : finder->GetFiducials()) {
        begin(probe, "fiducial", i);
        fprintf(probe.out, " %s %d %.9f %.9f %.9f\n", seen.mod->Token(), seen.id, seen.range,
                seen.bearing, seen.geom.a);
      }
    } else if (Stg::ModelBlobfinder *blobs = dynamic_cast<Stg::ModelBlobfinder *>(device)) {
      for (const Stg::ModelBlobfinder::Blob &seen : blobs->GetBlobs()) {
        begin(probe, "blob", i);
        fprintf(probe.out, " %.3f %.3f %.3f %u %u %.9f\n", seen.color.r, seen.color.g,
                seen.color.b, seen.left, seen.right, double(seen.range));
      }
    } else if (Stg::ModelBumper *bumper = dynamic_cast<Stg::ModelBumper *>(device)) {
      begin(probe, "bumps", i);
      for (unsigned int k = 0; bumper->samples && k < bumper->bumper_count; ++k)
        fprintf(probe.out, " %s", bumper->samples[k].hit ? bumper->samples[k].hit->Token() : "-");
      fputc('\n', probe.out);
    }
  }
}

int watch(Stg::World *, void *user)
{
  Probe &probe = *static_cast<Probe *>(user);
  ++probe.steps;
  write_pose(probe);
  if (probe.steps == LOOK)
    write_senses(probe);
  fflush(probe.out);
  return 0;
}

int roam(Stg::World *, void *user)
{
  Probe &probe = *static_cast<Probe *>(user);
  if (probe.robot->Stalled() && probe.back == 0)
    probe.back = 10;
  if (probe.left-- == 0) {
    probe.left = 10;
    probe.robot->SetTurnSpeed(1.2 * drand48() - 0.6);
  }
  probe.robot->SetXSpeed(probe.back > 0 ? -0.2 : 0.4);
  if (probe.back > 0)
    --probe.back;
  return 0;
}

FILE *output()
{
  static const char *name = getenv("STAGE_PROBE");
  static FILE *out = name ? fopen(name, "w") : nullptr;
  return out;
}

} // namespace

extern "C" int Init(Stg::Model *model, Stg::CtrlArgs *args)
{
  Probe *probe = new Probe{dynamic_cast<Stg::ModelPosition *>(model), {}, output(), 0, 0, 0};
  double x = 0.0, y = 0.0, turn = 0.0;
  const bool driven = sscanf(args->worldfile.c_str(), "%*s drive %lf %lf %lf", &x, &y, &turn) == 3;
  collect(model, probe->devices);
  model->Subscribe();
  if (!driven) {
    model->GetWorld()->AddUpdateCallback(roam, probe);
    return 0;
  }
  for (Stg::Model *device : probe->devices)
    device->Subscribe();
  probe->robot->SetSpeed(x, y, turn);
  if (probe->out)
    model->GetWorld()->AddUpdateCallback(watch, probe);
  return 0;
}
