// The states of a run, as files and as pictures.
#pragma once

#include <string>
#include <vector>

#include "cloth/scenes.h"
#include "ibmfair/picture/image.h"

namespace ibmfair::cloth {

inline constexpr double frames_per_second = 25;
inline constexpr int picture_width = 560;  ///< pixels of one state

/// Runs the scene for this number of seconds; the first frame is the initial state.
std::vector<Points> run_frames(const Scene& scene, Integrator& integrator, double seconds);

/// The name of a frame's file.
std::string frame_path(const std::string& folder, std::size_t frame, const std::string& format);

/// Writes each frame as a mesh `folder`/frame_NNNN.`format`, replacing existing files. Throws
/// CannotWrite.
void write_frames(const Scene& scene, const std::vector<Points>& frames, const std::string& folder,
                  const std::string& format);

/// `count` of the frames from left to right, with the sphere of the scene: the last one, and
/// ever closer ones towards the start, where most happens.
Image picture_of(const Scene& scene, const std::vector<Points>& frames, const View& view,
                 int count);

}  // namespace ibmfair::cloth
