#include "TrimSummary.h"

#include "ArrayNames.h"
#include "TrimSelection.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"

#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMSourceProxy.h"

#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QMainWindow>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace
{
namespace names = trim::names;

struct Entry
{
  const char* Array;
  const char* Meaning;
};

const std::vector<Entry> Entries = {
  { names::Kept, "elements that stayed" },
  { names::Eliminated, "elements that went" },
  { names::Treated, "elements crossed by the surface" },
  { names::MovedNodes, "nodes that were moved" },
  { names::TouchedElements, "elements at moved nodes" },
  { names::CertifiedElements, "touched elements proved valid everywhere" },
  { names::Pentahedra, "elements pressed to five sides" },
  { names::Wedges, "of these, now six-node wedges" },
  { names::MinimumScaledJacobian, "worst touched element, at its corners" },
  { names::MinimumIntegrationPointJacobian, "worst touched element, at integration points" },
  { names::MaximumDistanceToSurface, "of the nodes of the new border" },
  { names::Volume, "of what is left" },
  { names::NodeBandwidth, "largest difference of node numbers in an element" },
  { names::RescuedByRelaxation, "elements saved by moving nodes round them" },
  { names::RescuedByTreatment, "columns saved by the other treatment" },
  { names::RescuedByCorrection, "columns saved by the other correction type" },
  { names::RescuedByFate, "columns kept or eliminated against their volume" },
  { names::RescuedByLeaving, "columns with nodes left off the surface" },
  { names::InsertedElements, "elements that the input does not have" },
};

std::vector<pqPipelineSource*> AllTrims()
{
  std::vector<pqPipelineSource*> trims;
  const auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (IsTrim(source->getProxy()) && source->modifiedState() != pqProxy::UNINITIALIZED)
    {
      trims.push_back(source);
    }
  }
  return trims;
}

/// Counts to the last digit, measures with nine.
QString TextOf(vtkPVArrayInformation* array)
{
  double range[2];
  array->GetComponentRange(0, range);
  if (range[0] > range[1]) // upside down: NaN, there was nothing to measure
  {
    return "-";
  }
  const bool measure = array->GetDataType() == VTK_DOUBLE || array->GetDataType() == VTK_FLOAT;
  return measure ? QString::number(range[0], 'g', 9) : QString::number(range[0], 'f', 0);
}

/// The entries of one trim; none if it failed.
std::map<std::string, QString> ValuesOf(pqPipelineSource* trim)
{
  std::map<std::string, QString> values;
  auto* arrays =
    trim->getSourceProxy()->GetDataInformation(0)->GetAttributeInformation(vtkDataObject::FIELD);
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkPVArrayInformation* array = arrays->GetArrayInformation(i);
    values[array->GetName()] = TextOf(array);
  }
  return values;
}

QTableWidgetItem* Cell(const QString& text, bool number)
{
  auto* cell = new QTableWidgetItem(text);
  cell->setTextAlignment((number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
  return cell;
}
}

TrimSummary::TrimSummary(QWidget* parent)
  : QDockWidget("Trim Summary", parent)
  , Table(new QTableWidget(this))
{
  this->setObjectName("TrimSummary");
  this->Table->setObjectName("Table");
  this->Table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  this->Table->setAlternatingRowColors(true);
  auto* copy = new QPushButton("Copy", this);
  copy->setObjectName("Copy");
  copy->setToolTip("Copy the table, to be pasted into a spreadsheet.");
  auto* content = new QWidget(this);
  content->setObjectName("Content");
  auto* layout = new QVBoxLayout(content);
  layout->addWidget(this->Table);
  layout->addWidget(copy, 0, Qt::AlignLeft);
  this->setWidget(content);
  QObject::connect(copy, &QPushButton::clicked, this, &TrimSummary::Copy);

  this->Delay.setSingleShot(true);
  QObject::connect(&this->Delay, &QTimer::timeout, this, &TrimSummary::Fill);
  const auto refresh = [this] { this->Delay.start(0); };
  const auto* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::dataUpdated, this, refresh);
  QObject::connect(model, &pqServerManagerModel::modifiedStateChanged, this, refresh);
  QObject::connect(model, &pqServerManagerModel::nameChanged, this, refresh);
  QObject::connect(model, &pqServerManagerModel::sourceRemoved, this, refresh);
  this->Fill();
}

void TrimSummary::Fill()
{
  const std::vector<pqPipelineSource*> trims = AllTrims();
  const int columnsBefore = this->Table->columnCount();
  this->Table->clear();
  this->Table->setRowCount(static_cast<int>(Entries.size()));
  this->Table->setColumnCount(static_cast<int>(trims.size()) + 1);
  QStringList rows;
  for (const Entry& entry : Entries)
  {
    const int row = rows.size();
    rows << entry.Array;
    this->Table->setItem(row, static_cast<int>(trims.size()), Cell(entry.Meaning, false));
  }
  QStringList columns;
  for (pqPipelineSource* trim : trims)
  {
    auto values = ValuesOf(trim);
    for (int row = 0; row < rows.size(); ++row)
    {
      this->Table->setItem(row, columns.size(), Cell(values[Entries[row].Array], true));
    }
    columns << trim->getSMName();
  }
  columns << (trims.empty() ? "Meaning (no trim was applied yet)" : "Meaning");
  this->Table->setHorizontalHeaderLabels(columns);
  this->Table->setVerticalHeaderLabels(rows);
  for (int row = 0; row < rows.size(); ++row)
  {
    this->Table->verticalHeaderItem(row)->setToolTip(Entries[row].Meaning);
  }
  this->Table->resizeColumnsToContents();
  this->Table->resizeRowsToContents();
  if (this->isFloating() && this->Table->columnCount() > columnsBefore)
  {
    this->ShowAllColumns();
  }
}

void TrimSummary::ShowAllColumns()
{
  const QRect room = pqCoreUtilities::mainWidget()->geometry();
  const int width = std::max(this->width(), std::min(this->SizeOfAll().width(), room.width()));
  this->resize(width, this->height());
  if (this->geometry().right() > room.right())
  {
    this->move(room.right() - width, this->y());
  }
}

QSize TrimSummary::SizeOfAll() const
{
  const QTableWidget& table = *this->Table;
  const int margin = 40;
  return { table.verticalHeader()->sizeHint().width() + table.horizontalHeader()->length() + margin,
    table.verticalHeader()->length() + table.horizontalHeader()->height() + 3 * margin };
}

void TrimSummary::Copy() const
{
  QString text;
  const int columns = this->Table->columnCount();
  for (int column = 0; column < columns; ++column)
  {
    text += "\t" + this->Table->horizontalHeaderItem(column)->text();
  }
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    text += "\n" + this->Table->verticalHeaderItem(row)->text();
    for (int column = 0; column < columns; ++column)
    {
      text += "\t" + this->Table->item(row, column)->text();
    }
  }
  QApplication::clipboard()->setText(text + "\n");
}

void TrimSummary::ShowInMainWindow()
{
  auto* window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
  auto* summary = window->findChild<TrimSummary*>();
  if (!summary)
  {
    // Beside the window's own panels at first: it can be docked by its title bar.
    summary = new TrimSummary(window);
    window->addDockWidget(Qt::BottomDockWidgetArea, summary);
    summary->setFloating(true);
    summary->show();
    summary->resize(summary->SizeOfAll());
    summary->move(window->geometry().center() - summary->rect().center());
  }
  summary->show();
  summary->raise();
}
