// What libsdformat makes of a file, all poses resolved: the oracle of test_resolved.py.
// A line each: kind, scoped name, and what belongs to it, separated by tabs.

#include <cstdlib>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>

#include <sdf/sdf.hh>

using Pose = ignition::math::Pose3d;
using Vector = ignition::math::Vector3d;

static std::string text(const Pose &pose) {
  std::ostringstream out;
  const auto &p = pose.Pos();
  const auto &q = pose.Rot();
  out << std::setprecision(17) << p.X() << ' ' << p.Y() << ' ' << p.Z() << ' ' << q.X() << ' '
      << q.Y() << ' ' << q.Z() << ' ' << q.W();
  return out.str();
}

template <typename Part>
static Pose placed(const Part &part, const std::string &in = "") {
  Pose pose;
  const auto errors = part.SemanticPose().Resolve(pose, in);
  if (!errors.empty()) std::cout << "error\t" << part.Name() << '\t' << errors[0].Message() << '\n';
  return pose;
}

static void print(const sdf::Link &link, const std::string &scope, const Pose &model) {
  const std::string name = scope + "::" + link.Name();
  std::cout << "link\t" << name << '\t' << text(model * placed(link, "__model__")) << '\n';
  const auto &inertial = link.Inertial();
  const auto &moments = inertial.MassMatrix();
  std::cout << "inertial\t" << name << '\t' << std::setprecision(17) << moments.Mass() << ' '
            << moments.Ixx() << ' ' << moments.Iyy() << ' ' << moments.Izz() << ' '
            << moments.Ixy() << ' ' << moments.Ixz() << ' ' << moments.Iyz() << ' '
            << text(inertial.Pose()) << '\n';
  for (uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const auto &part = *link.CollisionByIndex(i);
    std::cout << "collision\t" << name << "::" << part.Name() << '\t' << text(placed(part))
              << '\n';
  }
  for (uint64_t i = 0; i < link.VisualCount(); ++i) {
    const auto &part = *link.VisualByIndex(i);
    std::cout << "visual\t" << name << "::" << part.Name() << '\t' << text(placed(part)) << '\n';
  }
  for (uint64_t i = 0; i < link.SensorCount(); ++i) {
    const auto &part = *link.SensorByIndex(i);
    std::cout << "sensor\t" << name << "::" << part.Name() << '\t' << text(placed(part)) << '\n';
  }
}

static void print(const sdf::Joint &joint, const std::string &scope) {
  std::string parent, child;
  joint.ResolveParentLink(parent);
  joint.ResolveChildLink(child);
  std::cout << "joint\t" << scope << "::" << joint.Name() << '\t' << parent << '\t' << child
            << '\t' << text(placed(joint, child));
  for (unsigned int i = 0; i < 2; ++i) {
    const auto *axis = joint.Axis(i);
    if (axis == nullptr) continue;
    Vector xyz;
    axis->ResolveXyz(xyz);
    std::cout << '\t' << std::setprecision(17) << xyz.X() << ' ' << xyz.Y() << ' ' << xyz.Z()
              << ' ' << axis->Lower() << ' ' << axis->Upper() << ' ' << axis->Effort() << ' '
              << axis->MaxVelocity() << ' ' << axis->Damping() << ' ' << axis->Friction();
  }
  std::cout << '\n';
}

static void print(const sdf::Model &model, const std::string &outer, const Pose &around,
                  const std::string &in) {
  const std::string scope = outer.empty() ? model.Name() : outer + "::" + model.Name();
  const Pose pose = around * placed(model, in);
  std::cout << "model\t" << scope << '\t' << text(pose) << '\t' << model.Static() << '\n';
  for (uint64_t i = 0; i < model.LinkCount(); ++i) print(*model.LinkByIndex(i), scope, pose);
  for (uint64_t i = 0; i < model.JointCount(); ++i) print(*model.JointByIndex(i), scope);
  for (uint64_t i = 0; i < model.FrameCount(); ++i) {
    const auto &frame = *model.FrameByIndex(i);
    std::string body;
    frame.ResolveAttachedToBody(body);
    std::cout << "frame\t" << scope << "::" << frame.Name() << '\t'
              << text(pose * placed(frame, "__model__")) << '\t' << body << '\n';
  }
  for (uint64_t i = 0; i < model.ModelCount(); ++i)
    print(*model.ModelByIndex(i), scope, pose, "__model__");
}

static std::string found(const std::string &uri) {
  const std::string scheme = "model://";
  const std::string name = uri.rfind(scheme, 0) == 0 ? uri.substr(scheme.size()) : uri;
  const char *paths = std::getenv("SDF_PATH");
  std::istringstream folders(paths == nullptr ? "" : paths);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto path = std::filesystem::path(folder) / name;
    if (std::filesystem::exists(path)) return path.string();
  }
  return "";
}

static void print(const std::string &file) {
  std::cout << "file\t" << file << '\n';
  sdf::ParserConfig config;
  config.SetFindCallback(found);
  sdf::Root root;
  const auto errors = root.Load(file, config);
  for (const auto &error : errors) std::cout << "error\t\t" << error.Message() << '\n';
  if (root.WorldCount() > 0) {
    const auto &world = *root.WorldByIndex(0);
    for (uint64_t i = 0; i < world.ModelCount(); ++i)
      print(*world.ModelByIndex(i), "", Pose::Zero, "world");
    for (uint64_t i = 0; i < world.LightCount(); ++i) {
      const auto &light = *world.LightByIndex(i);
      std::cout << "light\t" << light.Name() << '\t' << text(placed(light, "world")) << '\n';
    }
  } else if (root.Model() != nullptr) {
    print(*root.Model(), "", Pose::Zero, "__root__");
  }
}

int main(int count, char **files) {
  sdf::Console::Instance()->SetQuiet(true);
  for (int i = 1; i < count; ++i) print(files[i]);
  return 0;
}
