// Messages from a worker, the process that verifies scenes, to its supervisor: results as they
// come, so that a crash loses only the cell that crashed.
#pragma once

#include "compare/report/report.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace shadowproof {

namespace messages {

/// OpenGL has started.
struct Begun {
    DriverInfo gl;
    std::string embree;
};
/// A scene is about to be read and traced under one of its lights. Its name and file are known.
struct SceneBegun {
    SceneResult scene;
};
/// The scene is read.
struct SceneRead {
    std::size_t lights = 1;  ///< under which it is tried
    bool none_suits = false; ///< none of the techniques is for it: it has no result
};
/// The scene is traced; all is known but its cells.
struct SceneTraced {
    SceneResult scene;
};
/// The scene cannot be tried.
struct SceneFailed {
    std::string name; ///< unique in the run
    std::string error;
};
/// A technique is about to be tried.
struct CellBegun {
    std::string technique;
    std::string summary;
};
/// It is judged, and its pictures are written.
struct CellDone {
    Cell cell;
    double report_milliseconds = 0; ///< spent on ledgers and pictures, those of the scene included
};
/// All techniques were tried under the light.
struct SceneDone {};
/// The run cannot go on.
struct RunFailed {
    std::string error;
};
/// All scenes were tried.
struct Done {};

} // namespace messages

using Message =
    std::variant<messages::Begun, messages::SceneBegun, messages::SceneRead, messages::SceneTraced,
                 messages::SceneFailed, messages::CellBegun, messages::CellDone,
                 messages::SceneDone, messages::RunFailed, messages::Done>;

/// Sends a message, without pictures and ledgers, which are on disk already. Throws Error if the
/// pipe has no reader any more.
void send(int pipe, const Message& message);

/// Reads messages from a pipe as their bytes come.
class MessageReader {
public:
    explicit MessageReader(int pipe) : pipe_(pipe) {}

    /// The next complete message; none if not all of its bytes have arrived. Waits for bytes at
    /// most this long, or for ever if negative.
    std::optional<Message> next(int milliseconds);
    /// The writing end is closed and all messages were read.
    bool at_end() const { return ended_ && !holds_message(); }

private:
    int pipe_;
    std::string bytes_;
    bool ended_ = false;

    bool holds_message() const;
    void read_some(int milliseconds);
};

} // namespace shadowproof
