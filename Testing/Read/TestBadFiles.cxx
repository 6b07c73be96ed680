/**
 * Files that are missing, broken or empty of surfaces: each is one error that names the file,
 * with an empty output, and nothing else is printed.
 */
#include "DecimalComma.h"
#include "IgesText.h"
#include "ReadTesting.h"

#include "vtkCADSurfaceReader.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkTrimLineSource.h"

#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
/// What the system does while a file is read.
enum class System
{
  Normal,
  Slow,   ///< the child goes on a long way between two calls of the parent
  Killer, ///< the child is killed, as for want of memory
  Stuck   ///< the child does not go on
};
System TheSystem = System::Normal;
}

// In place of the C library's, for the reader too.
extern "C" pid_t waitpid(pid_t process, int* status, int options)
{
  if (TheSystem == System::Slow && options == WNOHANG)
  {
    usleep(1000000);
  }
  if (TheSystem == System::Killer)
  {
    kill(process, SIGKILL);
  }
  if (TheSystem == System::Stuck)
  {
    kill(process, SIGSTOP);
  }
  return wait4(process, status, options, nullptr);
}

extern "C" int poll(pollfd* files, nfds_t count, int timeout)
{
  const bool brief = TheSystem == System::Slow && timeout > 0;
  return static_cast<int>(syscall(SYS_poll, files, count, brief ? 1 : timeout));
}

namespace
{
/// Collects what is written to stdout and stderr while it lives.
class OutputCapture
{
public:
  OutputCapture()
    : Path(OutputPath("printed.txt"))
  {
    this->Flush();
    const int file = open(this->Path.c_str(), O_CREAT | O_TRUNC | O_RDWR, 0600);
    for (int stream : { 1, 2 })
    {
      this->Saved[stream - 1] = dup(stream);
      dup2(file, stream);
    }
    close(file);
  }
  ~OutputCapture() { this->Finish(); }

  std::string Finish()
  {
    this->Flush();
    for (int stream : { 1, 2 })
    {
      if (this->Saved[stream - 1] >= 0)
      {
        dup2(this->Saved[stream - 1], stream);
        close(this->Saved[stream - 1]);
        this->Saved[stream - 1] = -1;
      }
    }
    return ReadText(this->Path);
  }

private:
  void Flush()
  {
    std::fflush(nullptr);
    std::cout.flush();
    std::cerr.flush();
  }
  std::string Path;
  int Saved[2] = { -1, -1 };
};

void CheckError(const std::string& path, const std::string& part)
{
  OutputCapture capture;
  const ReadResult result = ReadFile(path);
  const std::string printed = capture.Finish();
  CHECK(result.Errors.size() == 1, path << ": " << result.Errors.size() << " errors");
  CHECK(result.Warnings.empty(), path << ": " << result.Warnings.size() << " warnings");
  CHECK(result.Output->GetNumberOfBlocks() == 0, path << ": the output is not empty");
  CHECK(printed.empty(), path << ": prints " << printed.substr(0, 300));
  if (!result.Errors.empty())
  {
    const std::string& error = result.Errors[0];
    CHECK(error.find(part) != std::string::npos, path << ": no \"" << part << "\" in " << error);
    CHECK(error.find(path) != std::string::npos, path << " is not named in " << error);
    // VTK puts two line ends behind the message, and one before it.
    const size_t colon = error.find("): ");
    CHECK(error.find('\n', colon) + 2 >= error.size(), path << ": more than one line: " << error);
  }
}

IgesText Curves()
{
  IgesText iges;
  iges.Add(110, "0.,0.,0.,10.,0.,0.");
  iges.Add(100, "0.,0.,0.,5.,0.,0.,5.");
  return iges;
}

/// A file in the output directory with this content.
std::string File(const std::string& name, const std::string& text)
{
  const std::string path = OutputPath(name);
  WriteText(path, text);
  return path;
}

/// Not the nearest one, by which all would come out in another size.
void TestNoUnit()
{
  const ReadResult result = ReadFile(File("unit.igs", Curves().Text()), 6);
  CHECK(result.Errors.size() == 1 &&
      result.Errors[0].find("LengthUnit is 6: give a number from 0 to 5.") != std::string::npos,
    "a unit that there is not");
}

void TestNoFile()
{
  CheckError(OutputPath("missing.igs"), "cannot be found");
  CheckError(OutputPath(""), "is a directory");
  CheckError(File("empty.igs", ""), "is empty");
  CheckError(File("empty.step", ""), "is empty");
  CheckError("/dev/null", "is no ordinary file");
  const std::string secret = File("secret.igs", Curves().Text());
  chmod(secret.c_str(), 0);
  if (access(secret.c_str(), R_OK) != 0)
  {
    CheckError(secret, "cannot be opened");
  }
  chmod(secret.c_str(), 0600);

  vtkNew<vtkCADSurfaceReader> reader;
  vtkNew<ErrorCapture> capture;
  capture->Watch(reader);
  reader->Update();
  CHECK(capture->Errors.size() == 1, "without a name: " << capture->Errors.size() << " errors");
}

void TestOtherContent()
{
  const std::string neither = "neither IGES nor STEP";
  CheckError(File("text.igs", "solid\nfacet normal 0 0 1\n"), neither);
  CheckError(File("text.step", "x"), neither);
  CheckError(File("zeros.stp", std::string(100000, '\0')), neither);
  CheckError(File("blank.igs", std::string(1000, ' ')), neither);
  CheckError(File("stl.step", "<?xml version=\"1.0\"?>\n<VTKFile/>\n"), neither);
  std::string noise;
  unsigned int state = 1;
  for (int i = 0; i < 50000; ++i)
  {
    state = state * 1664525u + 1013904223u;
    noise.push_back(static_cast<char>(state >> 24));
  }
  CheckError(File("noise.igs", noise), neither);
}

/// Cut after every tenth line, and within lines.
void TestTruncated()
{
  for (const char* name : { "RearDoor.igs", "SidePanelOuter.igs" })
  {
    const std::string text = ReadText(std::string(EXAMPLE_DATA) + "/" + name);
    for (size_t length = 81; length + 81 < text.size(); length += 810)
    {
      CheckError(File("cut.igs", text.substr(0, length)), "is cut short");
      CheckError(File("cut.igs", text.substr(0, length + 37)), "is cut short");
    }
  }
  // A gap in the middle: fewer lines than the last one promises.
  const std::string text = ReadText(std::string(EXAMPLE_DATA) + "/RearDoor.igs");
  CheckError(File("gap.igs", text.substr(0, 81 * 80) + text.substr(81 * 83)), "is cut short");
  const std::string step = ReadText(std::string(READ_TEST_FILES) + "/solvespace-plate.step");
  for (size_t length : { size_t(20), size_t(500), step.size() / 2, step.size() - 30 })
  {
    CheckError(File("cut.step", step.substr(0, length)), "is cut short");
  }
}

void TestNoSurface()
{
  const std::string curves = OutputPath("curves.igs");
  Curves().Write(curves);
  CheckError(curves, "holds curves but no surface");
  CheckError(File("nothing.igs", IgesText().Text()), "");
  CheckError(File("nothing.step",
               "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
               "FILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\n"
               "ENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n"),
    "");
  CheckError(File("assembly.step",
               "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
               "FILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\n"
               "ENDSEC;\nDATA;\n#1=DOCUMENT_TYPE('geometry');\n"
               "#2=DOCUMENT_FILE('door.stp','','',#1,'',$);\nENDSEC;\nEND-ISO-10303-21;\n"),
    "the names of other files, first \"door.stp\"");
  CheckError(File("garbage.step", "ISO-10303-21;\nHEADER;\n@@@((((;\nEND-ISO-10303-21;\n"), "");
  // A spline whose numbers make no sense.
  IgesText broken;
  broken.Add(128, "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.");
  CheckError(File("broken.igs", broken.Text()), "nothing else is in it");
  IgesText compressed;
  std::string text = compressed.Text();
  text[72] = 'C';
  CheckError(File("compressed.igs", text), "compressed or binary");
}

/// Weights that OpenCASCADE would take for one without a word.
void TestWeights()
{
  const std::string knots = "0.,0.,1.,1.,0.,0.,1.,1.,";
  const std::string points = ",0.,0.,0.,9.,0.,0.,0.,9.,0.,9.,9.,3.,0.,1.,0.,1.";
  for (const char* weight : { "-1.", "0.", "-2.D-1" })
  {
    IgesText iges;
    iges.Add(128, "1,1,1,1,0,0,0,0,0," + knots + "1.,1.,1.,1." + points);
    iges.Add(128, "1,1,1,1,0,0,0,0,0," + knots + "1.,2.," + std::string(weight) + ",1." + points);
    CheckError(File("weight.igs", iges.Text()), "weight 3 of the B-spline at directory line D3");
  }
  IgesText good;
  good.Add(128, "1,1,1,1,0,0,0,0,0," + knots + "1.,2.D0,2.5E-1,+1." + points);
  ReadFaces(File("weight.igs", good.Text()), 1);
  IgesText small;
  small.Add(128, "1,1,1,1,0,0,0,0,0," + knots + "0.5,0.5,.5,5.D-1" + points);
  const std::string halves = File("weight.igs", small.Text());
  ReadFaces(halves, 1);
  const DecimalComma comma; // as users may have; where there is none, the same once more
  ReadFaces(halves, 1);
}

/// References to nothing, on which OpenCASCADE 7.6 crashes.
void TestCrash()
{
  const std::string text = ReadText(std::string(READ_TEST_FILES) + "/solvespace-plate.step");
  std::string broken = text;
  const size_t point = broken.find("=CARTESIAN_POINT", broken.find("VERTEX_POINT"));
  broken.insert(broken.rfind('#', point) + 1, "99");
  CheckError(File("crash.step", broken), "crash");
}

/// What the child has sent when it ends is read, and a child that was killed was not slow.
void TestChild()
{
  const std::string good = std::string(EXAMPLE_DATA) + "/RearDoor.igs";
  TheSystem = System::Slow;
  ReadFaces(good, 12);
  TheSystem = System::Killer;
  CheckError(good, "the system ended the reading process");
  // By the clock, where no processor time passes: ten times what was asked for.
  TheSystem = System::Stuck;
  vtkNew<vtkCADSurfaceReader> reader;
  vtkNew<ErrorCapture> capture;
  capture->Watch(reader);
  reader->SetFileName(good.c_str());
  reader->SetTimeLimit(0.01);
  reader->Update();
  TheSystem = System::Normal;
  CHECK(capture->Errors.size() == 1 &&
      capture->Errors[0].find("takes too long to read") != std::string::npos,
    "a child that does not go on: " << (capture->Errors.empty() ? "no error" : capture->Errors[0]));
}

/// The longest time that may be given is one that the clock can count.
void TestLongestTime()
{
  const ReadResult result = ReadFile(std::string(EXAMPLE_DATA) + "/RearDoor.igs", 0, 1e9);
  CHECK(result.Errors.empty() && result.Surfaces.size() == 12,
    "the longest time: " << (result.Errors.empty() ? "faces" : result.Errors[0]));
}

/// A few bytes changed at random: an error, a warning, or surfaces, but nothing else.
void TestMutated()
{
  unsigned int state = 2026;
  auto random = [&state](size_t below)
  {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % below;
  };
  const std::string sources[] = { std::string(EXAMPLE_DATA) + "/RearDoor.igs",
    std::string(READ_TEST_FILES) + "/gotools-cylinder-sphere.igs",
    std::string(READ_TEST_FILES) + "/solvespace-plate.step" };
  for (int run = 0; run < 90; ++run)
  {
    std::string text = ReadText(sources[run % 3]);
    for (size_t changes = 1 + random(8); changes > 0; --changes)
    {
      text[random(text.size())] = static_cast<char>(32 + random(95));
    }
    const std::string path = File(run % 3 < 2 ? "mutated.igs" : "mutated.step", text);
    const ReadResult result = ReadFile(path);
    CHECK(result.Errors.size() <= 1 && result.Warnings.size() <= 1, "run " << run);
    CHECK(result.Errors.empty() != result.Surfaces.empty(), "run " << run << ": error or surfaces");
  }
}

void TestCanReadFile()
{
  auto canRead = [](const std::string& path)
  { return vtkCADSurfaceReader::CanReadFile(path.c_str()); };
  CHECK(canRead(std::string(EXAMPLE_DATA) + "/RearDoor.igs") == 1, "IGES");
  CHECK(canRead(std::string(READ_TEST_FILES) + "/solvespace-plate.step") == 1, "STEP");
  // By content, not by name.
  CHECK(canRead(File("misnamed.txt", Curves().Text())) == 1, "misnamed");
  CHECK(canRead(File("text.txt", "solid\n")) == 0, "text");
  // By name, too, so that the reader tells what is wrong with a file.
  for (const char* name : { "text.igs", "text.IGES", "text.a.stp", "text.Step" })
  {
    CHECK(canRead(File(name, "solid\n")) == 1, "text called " << name);
  }
  CHECK(canRead(File("igs", "solid\n")) == 0, "text without an extension");
  const std::string step = "ISO-10303-21;\nHEADER;\n";
  CHECK(canRead(File("mark.txt", "\xEF\xBB\xBF" + step)) == 1, "STEP behind a byte order mark");
  CHECK(canRead(File("comment.txt", "/* by hand */\n/**/ " + step)) == 1, "STEP behind comments");
  CHECK(canRead(File("open.txt", "/* by hand " + step)) == 0, "a comment without an end");
  CHECK(canRead(OutputPath("missing.igs")) == 0, "missing");
  CHECK(canRead(OutputPath("")) == 0, "directory");
  const std::string pipe = OutputPath("pipe.igs");
  mkfifo(pipe.c_str(), 0600);
  CHECK(canRead(pipe) == 0, "a pipe to which nobody writes");
  CheckError(pipe, "is no ordinary file");
  unlink(pipe.c_str());
  CHECK(vtkCADSurfaceReader::CanReadFile(nullptr) == 0, "null");
}

/// After an error the same reader reads a good file, and line ends do not matter.
void TestRecovery()
{
  vtkNew<vtkCADSurfaceReader> reader;
  vtkNew<ErrorCapture> capture;
  capture->Watch(reader);
  reader->SetFileName(OutputPath("missing.igs").c_str());
  reader->Update();
  std::string text = ReadText(std::string(EXAMPLE_DATA) + "/RearDoor.igs");
  for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
  {
    text.insert(at, 1, '\r');
  }
  reader->SetFileName(File("dos.igs", text).c_str());
  reader->Update();
  CHECK(capture->Errors.size() == 1, capture->Errors.size() << " errors");
  CHECK(reader->GetOutput()->GetNumberOfBlocks() == 12, "faces");
  reader->SetFileName(OutputPath("missing.igs").c_str());
  reader->Update();
  CHECK(reader->GetOutput()->GetNumberOfBlocks() == 0, "old faces stay after an error");
}

/// Aborts what tells of its progress, from some share on.
struct AbortAtProgress : public vtkCommand
{
  static AbortAtProgress* New() { return new AbortAtProgress; }
  void Execute(vtkObject* caller, unsigned long, void* progress) override
  {
    if (*static_cast<double*>(progress) >= this->From)
    {
      ++this->Calls;
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    }
  }
  int Calls = 0;
  double From = 0.0;
};

/// Aborting leaves the output empty, without an error: as soon as the file is read, though that
/// does not go on, and between its faces.
void TestAbort(double from, System system)
{
  vtkNew<vtkCADSurfaceReader> reader;
  vtkNew<ErrorCapture> capture;
  capture->Watch(reader);
  vtkNew<AbortAtProgress> abort;
  abort->From = from;
  reader->AddObserver(vtkCommand::ProgressEvent, abort);
  reader->SetFileName((std::string(EXAMPLE_DATA) + "/RearDoor.igs").c_str());
  TheSystem = system;
  reader->Update();
  TheSystem = System::Normal;
  CHECK(abort->Calls > 0, "no progress");
  CHECK(capture->Errors.empty(), "an error on abort");
  CHECK(reader->GetOutput()->GetNumberOfBlocks() == 0, "output after abort");
}

/// The same of trim lines; the next update reads them after all.
void TestAbortOfLines()
{
  vtkNew<vtkTrimLineSource> source;
  vtkNew<ErrorCapture> capture;
  capture->Watch(source);
  vtkNew<AbortAtProgress> abort;
  const unsigned long tag = source->AddObserver(vtkCommand::ProgressEvent, abort);
  IgesText iges;
  iges.Add(110, "0.,0.,0.,10.,0.,0.");
  source->SetFileName(File("line.igs", iges.Text()).c_str());
  TheSystem = System::Stuck;
  source->Update();
  TheSystem = System::Normal;
  CHECK(abort->Calls > 0 && capture->Errors.empty(), "a line: no abort, or an error");
  CHECK(source->GetOutput()->GetNumberOfPoints() == 0, "a line after abort");
  source->RemoveObserver(tag);
  source->SetAbortExecute(0);
  source->Modified();
  source->Update();
  CHECK(capture->Errors.empty() && source->GetOutput()->GetNumberOfPoints() > 0, "no line at last");
}
}

int main()
{
  TestNoFile();
  TestNoUnit();
  TestOtherContent();
  TestTruncated();
  TestNoSurface();
  TestWeights();
  TestCrash();
  TestChild();
  TestLongestTime();
  TestMutated();
  TestCanReadFile();
  TestRecovery();
  TestAbort(0.0, System::Normal);
  TestAbort(0.0, System::Stuck);
  TestAbort(0.85, System::Normal);
  TestAbortOfLines();
  return Failures != 0;
}
